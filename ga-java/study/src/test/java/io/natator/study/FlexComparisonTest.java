package io.natator.study;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.InvalidInputException;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import io.natator.simulator.SimulationResult.Status;
import io.natator.simulator.Simulator;
import io.natator.simulator.WorkerPool;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.List;
import java.util.concurrent.ConcurrentLinkedQueue;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class FlexComparisonTest {

    private static final int RUNS = 3;
    private static final Variant FIRST = StudyFixtures.variant("first", "{\"solver\":{\"damping\":0.1}}", 1.0, 1.2);
    private static final Variant SECOND = StudyFixtures.variant("second", "{\"solver\":{\"damping\":0.2}}", 2.0);

    @TempDir
    private Path directory;
    private Path log;
    private final FakeSimulator simulator = new FakeSimulator();

    @BeforeEach
    void chooseLog() {
        log = directory.resolve("evaluations.jsonl");
    }

    @Test
    void everySeedOfEveryIntervalIsRunOnce() throws InterruptedException {
        List<Comparison> comparisons = study(FIRST, SECOND);
        assertThat(simulator.requests).hasSize(2 * 2 * (1 + RUNS)).doesNotHaveDuplicates();
        assertThat(simulator.requests).filteredOn(request -> request.perturbation() == null).hasSize(2 * 2);
        assertThat(simulator.requests).filteredOn(request -> request.perturbation() != null).allSatisfy(request -> {
            assertThat(request.perturbation().amplitude()).isEqualTo(1e-6);
            assertThat(request.perturbation().seed()).isBetween(1L, 3L);
        });
        assertThat(comparisons).hasSize(4);
        Comparison last = comparisons.get(3);
        assertThat(last.variant()).isSameAs(SECOND);
        assertThat(last.interval()).isEqualTo(Interval.FOUR_SECONDS);
        assertThat(last.ours().mean()).isCloseTo(2 + 0.2, within(1e-12));
        assertThat(last.ours().standardDeviation()).isCloseTo(1, within(1e-12));
        assertThat(last.asStated()).isCloseTo(0.2, within(1e-12));
    }

    @Test
    void finishedEvaluationsAreNotRunAgain() throws InterruptedException {
        List<Comparison> before = study(FIRST, SECOND);
        simulator.requests.clear();
        assertThat(study(FIRST, SECOND)).isEqualTo(before);
        assertThat(simulator.requests).isEmpty();
    }

    @Test
    void aLineCutShortIsRunAgain() throws InterruptedException, IOException {
        List<Comparison> before = study(FIRST);
        String content = Files.readString(log);
        Files.writeString(log, content.substring(0, content.length() - 40));
        simulator.requests.clear();
        assertThat(study(FIRST)).isEqualTo(before);
        assertThat(simulator.requests).hasSize(1);
        assertThat(Files.readAllLines(log)).hasSize(2 * (1 + RUNS));
    }

    @Test
    void failuresAreTriedAgainAndUnstableRunsAreNot() throws InterruptedException {
        simulator.statusOfSeedTwo = Status.FAILED;
        assertThat(study(FIRST).get(0).ours().count()).isEqualTo(RUNS - 1);
        simulator.requests.clear();
        simulator.statusOfSeedTwo = Status.UNSTABLE;
        assertThat(study(FIRST).get(0).ours().count()).isEqualTo(RUNS - 1);
        assertThat(simulator.requests).hasSize(2);
        simulator.requests.clear();
        study(FIRST);
        assertThat(simulator.requests).isEmpty();
    }

    @Test
    void otherSettingsAndOtherProgramsAreRunAnew() throws InterruptedException {
        study(FIRST, SECOND);
        simulator.requests.clear();
        Variant changed = StudyFixtures.variant("second", "{\"solver\":{\"damping\":0.3}}", 2.0);
        study(FIRST, changed);
        assertThat(simulator.requests).hasSize(2 * (1 + RUNS))
                .allMatch(request -> request.overrides().equals(changed.overrides()));
        simulator.requests.clear();
        new FlexComparison(List.of(FIRST), RUNS, log, "another program").run(new WorkerPool(simulator, 1), null);
        assertThat(simulator.requests).hasSize(2 * (1 + RUNS));
    }

    @Test
    void moreRunsAddToThoseThatAreThere() throws InterruptedException {
        study(FIRST);
        simulator.requests.clear();
        new FlexComparison(List.of(FIRST), RUNS + 2, log, "program").run(new WorkerPool(simulator, 1), null);
        assertThat(simulator.requests).hasSize(2 * 2);
    }

    @Test
    void onlyOneVariantIsEvaluatedButTheOthersAreKept() throws InterruptedException {
        study(FIRST);
        simulator.requests.clear();
        FlexComparison both = new FlexComparison(List.of(FIRST, SECOND), RUNS, log, "program");
        assertThat(both.run(new WorkerPool(simulator, 1), "first")).hasSize(2);
        assertThat(simulator.requests).isEmpty();
        assertThat(both.run(new WorkerPool(simulator, 1), "second")).hasSize(4);
    }

    @Test
    void theNumberOfWorkersChangesNothing() throws InterruptedException, IOException {
        study(FIRST, SECOND);
        String one = Files.readString(log);
        Files.delete(log);
        new FlexComparison(List.of(FIRST, SECOND), RUNS, log, "program").run(new WorkerPool(simulator, 4), null);
        assertThat(Files.readString(log)).isEqualTo(one);
    }

    @Test
    void aDamagedLogIsNamedAndKept() throws InterruptedException, IOException {
        study(FIRST);
        Files.writeString(log, "noise\n", StandardOpenOption.APPEND);
        String before = Files.readString(log);
        assertThatThrownBy(() -> study(FIRST)).isInstanceOf(InvalidInputException.class)
                .hasMessageStartingWith(log + ", line " + (2 * (1 + RUNS) + 1) + ": ");
        assertThat(log).hasContent(before);
    }

    private List<Comparison> study(Variant... variants) throws InterruptedException {
        return new FlexComparison(List.of(variants), RUNS, log, "program").run(new WorkerPool(simulator, 1), null);
    }

    /** Swims at the speed seed + damping, whatever the time; the seed is 0 where there is no perturbation. */
    private static final class FakeSimulator implements Simulator {

        private final ConcurrentLinkedQueue<SimulationRequest> requests = new ConcurrentLinkedQueue<>();
        private Status statusOfSeedTwo = Status.OK;

        @Override
        public SimulationResult evaluate(SimulationRequest request) {
            requests.add(request);
            long seed = request.perturbation() == null ? 0 : request.perturbation().seed();
            Status status = seed == 2 ? statusOfSeedTwo : Status.OK;
            double speed = seed + request.overrides().at("/solver/damping").asDouble();
            return new SimulationResult(request.id(), status, speed * request.duration(), "completed",
                    request.duration(), 1, "flex", "float", "0000000000000000", null, null);
        }

        @Override
        public void close() {
            // Holds nothing.
        }
    }
}
