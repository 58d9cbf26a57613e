package io.natator.verdict;

import static io.natator.verdict.Measure.Outcome.FAILS;
import static io.natator.verdict.Measure.Outcome.HOLDS;
import static io.natator.verdict.Measure.Outcome.NOT_MEASURED;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.FreshRuns;
import io.natator.checkpoint.SwimSample;
import io.natator.config.Aggregate;
import io.natator.encoding.Gait;
import io.natator.protocol.SimulationResult;
import java.util.Arrays;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class MeasureTest {

    private static final Gait GAIT = new Gait(2, List.of(0.1), List.of(0.0));

    private static SimulationResult result(double distance) {
        return new SimulationResult(0L, SimulationResult.Status.OK, distance, "completed", 4.0, 240, "conserving",
                "float", null, null,
                null);
    }

    private static SwimSample sample(double... distances) {
        return SwimSample.of(Arrays.stream(distances).mapToObj(MeasureTest::result).toList(), 4, GAIT, 4.0, 1.25);
    }

    private static BestGait best(FreshRuns fresh, double vacuum) {
        return new BestGait("pool/creature-1", List.of(1.0), GAIT, null, 2.5, 0.625, result(2.5), 1.25, result(vacuum),
                2.5, 1, fresh);
    }

    @Test
    void aWinnerWithAllThatCanBeKnown() {
        FreshRuns fresh = FreshRuns.of(4.0, sample(1.9, 2.1), sample(1.8, 1.8), Aggregate.MEAN, 2.5, 1, List.of(2.0));
        Controls controls = new Controls(GAIT, null, "conserving", 4.0, 1.25, sample(1.9, 2.1), sample(0.0),
                sample(0.0), null,
                sample(1.8), sample(0.5), sample(2.0), "cuda", 0.4);

        assertThat(Measure.of(best(fresh, 0), controls))
                .extracting(Measure::name, Measure::value, Measure::outcome).containsExactly(
                        tuple("way, 2 fresh starts", "1.600 ± 0.113 body lengths", HOLDS),
                        tuple("half the time step", "1.440 ± 0.000 body lengths", HOLDS),
                        tuple("without water", "0 % of its speed", HOLDS),
                        tuple("lost since it was chosen", "20.0 %", FAILS),
                        tuple("resting muscles", "0.000 ± 0.000 body lengths", HOLDS),
                        tuple("mirrored", "25 % of its way", FAILS),
                        tuple("on cuda", "100 % of its way", HOLDS),
                        tuple("share of the body under water", "40 %", FAILS));
    }

    @Test
    void whatIsNotKnownIsSaidSo() {
        assertThat(Measure.of(best(null, 2.0), null)).extracting(Measure::name, Measure::value, Measure::outcome)
                .containsExactly(
                        tuple("way, one run", "2.00 body lengths", HOLDS),
                        tuple("half the time step", "", NOT_MEASURED),
                        tuple("without water", "80 % of its speed", FAILS), tuple("resting muscles", "", NOT_MEASURED),
                        tuple("mirrored", "", NOT_MEASURED));
    }

    /** The length of its body is known, though it is the unit. */
    @Test
    void aBodyOfLengthOneIsMeasuredByItself() {
        Controls controls = new Controls(GAIT, null, "conserving", 4.0, 1.0, sample(1.9), sample(0.0), sample(0.0),
                null, sample(1.8),
                sample(1.9), null, null, null);
        BestGait best = new BestGait("pool/creature-1", List.of(1.0), GAIT, null, 2.5, 0.625, result(2.5), 1.0,
                result(0), 2.5, 1, null);

        assertThat(Measure.of(best, controls))
                .filteredOn(one -> List.of("way, one run", "resting muscles").contains(one.name()))
                .hasSize(2).allSatisfy(one -> assertThat(one.value() + one.expected()).contains("body lengths")
                        .doesNotContain("units"));
    }

    @Test
    void aRunThatGoesOnIsNotJudgedByUnits() {
        BestGait best = new BestGait("pool/creature-1", List.of(1.0), GAIT, 0.001, 0.001, result(0.001), null, null);

        assertThat(Measure.of(best, null))
                .extracting(Measure::name, Measure::value, Measure::expected, Measure::outcome).contains(
                        tuple("way, one run", "0.00 units", "more than 0.05 body lengths", NOT_MEASURED));
    }

    /** What gets faster with the time step is no more converged than what gets slower. */
    @ParameterizedTest
    @CsvSource({"0.9, FAILS", "1.1, HOLDS", "2.9, HOLDS", "3.1, FAILS"})
    void halfTheTimeStepMayChangeAWayByHalfOfIt(double half, Measure.Outcome outcome) {
        FreshRuns fresh = FreshRuns.of(4.0, sample(1.9, 2.1), sample(half), Aggregate.MEAN, 2.0, 1, List.of(2.0));

        assertThat(Measure.of(best(fresh, 0), null)).filteredOn(one -> one.name().equals("half the time step"))
                .extracting(Measure::outcome, Measure::expected)
                .containsExactly(tuple(outcome, "its way to within half of it"));
    }

    @Test
    void runsThatDifferTooMuchDoNotShowAWay() {
        FreshRuns fresh = FreshRuns.of(4.0, sample(-1, 1.4), sample(0.05), Aggregate.MEAN, 0.3, 1, List.of(0.2));

        assertThat(Measure.of(best(fresh, 0), null)).extracting(Measure::outcome).startsWith(FAILS, FAILS, HOLDS,
                FAILS);
    }
}
