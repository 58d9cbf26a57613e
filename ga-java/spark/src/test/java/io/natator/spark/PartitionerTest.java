package io.natator.spark;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import io.natator.encoding.Gait;
import io.natator.protocol.SimulationRequest;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.SplittableRandom;
import java.util.stream.Collectors;
import java.util.stream.LongStream;
import org.junit.jupiter.api.Test;

class PartitionerTest {

    private static final Gait GAIT = new Gait(1.5, List.of(0.1, 0.2), List.of(0.0, 0.3));
    private static final JsonNode VACUUM = JsonNodeFactory.instance.objectNode().set("fluid",
            JsonNodeFactory.instance.nullNode());

    private static SimulationRequest request(long id, JsonNode overrides) {
        return new SimulationRequest(id, "thesis/creature-1", GAIT, 4.0, null, overrides);
    }

    private static List<SimulationRequest> requests(int count) {
        return LongStream.range(0, count).mapToObj(id -> request(id, null)).toList();
    }

    /** Parts by evaluations that have taken so many seconds each. */
    private static Partitioner known(double seconds) {
        Partitioner parts = new Partitioner();
        parts.took(requests(1), seconds);
        return parts;
    }

    private static List<Integer> sizes(List<List<SimulationRequest>> parts) {
        return parts.stream().map(List::size).toList();
    }

    @Test
    void everyRequestIsInOnePart() {
        SplittableRandom random = new SplittableRandom(1);
        for (int i = 0; i < 2000; i++) {
            List<SimulationRequest> all = requests(random.nextInt(1, 400));
            int slots = random.nextInt(1, 300);
            Partitioner parts = random.nextInt(4) == 0 ? new Partitioner()
                    : known(Math.pow(10, random.nextDouble(-4, 2)));

            assertThat(parts.of(all, slots)).noneMatch(Collection::isEmpty);
            assertThat(parts.of(all, slots).stream().flatMap(List::stream).toList()).isEqualTo(all);
            assertThat(Partitioner.evenly(all, slots).stream().flatMap(List::stream).toList()).isEqualTo(all);
            assertThat(Partitioner.evenly(all, slots)).hasSize(Math.min(slots, all.size()));
        }
    }

    @Test
    void whatTakesUnknownTimeIsOneEach() {
        assertThat(sizes(new Partitioner().of(requests(150), 2))).hasSize(150).containsOnly(1);
        assertThat(new Partitioner().of(requests(100_000), 2)).hasSizeLessThanOrEqualTo(512);
    }

    /** An evaluation of the thesis takes 0.36 s: 2 s are five. */
    @Test
    void partsShrinkFromTwoSecondsToOneEvaluation() {
        List<Integer> sizes = sizes(known(0.36).of(requests(150), 2));

        assertThat(sizes).isSortedAccordingTo((one, other) -> other - one).startsWith(5, 5, 5).endsWith(1, 1, 1);
        assertThat(sizes).hasSizeLessThan(40);
    }

    /** 5 ms each: 150 that would be 150 parts are a few, of which none is shorter than ten times what a part costs. */
    @Test
    void cheapEvaluationsAreFewParts() {
        List<Integer> sizes = sizes(known(0.005).of(requests(150), 2));

        assertThat(sizes).hasSizeLessThan(12);
        assertThat(sizes.subList(0, sizes.size() - 1)).allMatch(size -> size >= 10);
    }

    @Test
    void kindsAreNotMixed() {
        Partitioner parts = known(0.1);
        parts.took(List.of(request(0, VACUUM)), 0.001);
        List<SimulationRequest> all = new ArrayList<>(requests(30));
        all.addAll(LongStream.range(30, 60).mapToObj(id -> request(id, VACUUM)).toList());

        List<List<SimulationRequest>> divided = parts.of(all, 1);

        assertThat(divided).allSatisfy(
                part -> assertThat(part.stream().map(SimulationRequest::overrides).collect(Collectors.toSet()))
                        .hasSize(1));
        assertThat(divided.stream().filter(part -> VACUUM.equals(part.get(0).overrides())).count()).isEqualTo(1);
    }
}
