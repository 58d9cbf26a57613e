package io.natator.verdict;

import static io.natator.verdict.Measure.Outcome.FAILS;
import static io.natator.verdict.Measure.Outcome.HOLDS;
import static io.natator.verdict.Measure.Outcome.NOT_MEASURED;
import static io.natator.verdict.Winners.best;
import static io.natator.verdict.Winners.controls;
import static io.natator.verdict.Winners.fresh;
import static io.natator.verdict.Winners.sample;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

import io.natator.checkpoint.Controls;
import io.natator.checkpoint.FreshRuns;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class MeasureTest {

    @Test
    void aWinnerWithAllThatCanBeKnown() {
        FreshRuns fresh = fresh(sample(1.9, 2.1), sample(1.8, 1.8), 2.5, 2.0);
        Controls controls = controls(sample(1.9, 2.1)).with(to -> to.resting(sample(0.0)).halfStep(sample(1.8))
                .mirrored(sample(0.5)).otherBackend(sample(2.0)).backend("cuda").underWater(0.4));

        assertThat(Measure.of(best(fresh, 0), controls))
                .extracting(Measure::name, Measure::value, Measure::outcome).containsExactly(
                        tuple("way, 2 fresh starts", "1.600 ± 0.113 body lengths", HOLDS),
                        tuple("half the time step", "1.440 ± 0.000 body lengths", HOLDS),
                        tuple("without water", "0 % of its speed", HOLDS),
                        tuple("lost since it was chosen", "20.0 %", FAILS),
                        tuple("resting muscles", "0.000 ± 0.000 body lengths", HOLDS),
                        tuple("mirrored", "25 % of its way", FAILS), tuple("on cuda", "100 % of its way", HOLDS),
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

    /** What gets faster with the time step is no more converged than what gets slower. */
    @ParameterizedTest
    @CsvSource({"0.9, FAILS", "1.1, HOLDS", "2.9, HOLDS", "3.1, FAILS"})
    void halfTheTimeStepMayChangeAWayByHalfOfIt(double half, Measure.Outcome outcome) {
        FreshRuns fresh = fresh(sample(1.9, 2.1), sample(half), 2.0, 2.0);

        assertThat(Measure.of(best(fresh, 0), null)).filteredOn(one -> one.name().equals("half the time step"))
                .extracting(Measure::outcome, Measure::expected)
                .containsExactly(tuple(outcome, "its way to within half of it"));
    }

    @Test
    void runsThatDifferTooMuchDoNotShowAWay() {
        FreshRuns fresh = fresh(sample(-1, 1.4), sample(0.05), 0.3, 0.2);

        assertThat(Measure.of(best(fresh, 0), null)).extracting(Measure::outcome).startsWith(FAILS, FAILS, HOLDS,
                FAILS);
    }
}
