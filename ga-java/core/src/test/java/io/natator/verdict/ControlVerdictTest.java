package io.natator.verdict;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.checkpoint.Controls;
import io.natator.checkpoint.Convergence;
import io.natator.checkpoint.SwimSample;
import io.natator.protocol.Results;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class ControlVerdictTest {

    /** Of two runs, so far from their mean. */
    private static SwimSample sample(double mean, double from) {
        return sample(mean, from, "completed");
    }

    private static SwimSample sample(double mean, double from, String stopped) {
        return Winners.sample(Stream.of(mean - from, mean + from).map(Results::ok).map(one -> one.withStopped(stopped))
                .toList());
    }

    /** Distances in 4 s of a body 1.25 long; a dead body drifts by -0.01. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "0.74|0.01|0.0|0.70|0.70|0.74|0.9|SWIMS|swims: 0.150 ± 0.003 body lengths/s more than a resting body, not in vacuum, without "
                    + "the acceleration clamp (95 %), at half the time step (95 % of its way), mirrored (100 %); 90 % under water",
            "0.05|0.01|0.0|0.05|0.05|0.05|0.9|DOES_NOT_SWIM|does not swim: moves 0.048 ± 0.011 body lengths further than a resting body "
                    + "in 4.00 s, less than 0.05",
            "0.74|0.01|-0.4|0.70|0.70|0.74|0.9|DOES_NOT_SWIM|does not swim: moves 0.5 times as far in vacuum, the other way",
            "0.74|0.01|0.0|-0.01|0.70|0.74|0.9|DOES_NOT_SWIM|does not swim: the acceleration clamp moves it; without, 0 % of its way "
                    + "is left",
            "0.74|0.01|0.0|0.70|0.20|0.74|0.9|UNPROVEN|may swim: 0.150 ± 0.003 body lengths/s more than a resting body; but at half the "
                    + "time step it has 28 % of its way",
            "0.74|0.01|0.0|0.70|1.20|0.74|0.9|UNPROVEN|may swim: 0.150 ± 0.003 body lengths/s more than a resting body; but at half the "
                    + "time step it has 161 % of its way",
            "0.74|0.01|0.0|0.70|0.70|-0.2|0.2|UNPROVEN|may swim: 0.150 ± 0.003 body lengths/s more than a resting body; but it skims: "
                    + "20 % of its body are under water; mirrored -25 % of its way is left",
            "0.74|0.70|0.0|0.70|0.70|0.74|0.9|UNPROVEN|may swim: 0.15 ± 0.20 body lengths/s more than a resting body; but its runs "
                    + "differ too much to tell"})
    void allControlsHaveTheirSay(double water, double from, double vacuum, double clampOff, double half,
            double mirrored, double underWater, Verdict.Kind kind, String text) {
        Controls controls = Winners.controls(sample(water, from)).with(to -> to.vacuum(sample(vacuum, 0))
                .clampOff(sample(clampOff, 0)).halfStep(sample(half, 0)).mirrored(sample(mirrored, 0))
                .underWater(underWater));

        assertThat(ControlVerdict.of(controls, null).text()).isEqualTo(text);
        assertThat(ControlVerdict.of(controls, null).kind()).isEqualTo(kind);
    }

    /** Of a net way of 0.75 half is 0.375: controls that are known no better than to this side or that of it decide nothing. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "0.5|0.05|0.7|0.0|DOES_NOT_SWIM|does not swim: moves 0.7 times as far in vacuum",
            "-0.5|0.1|0.7|0.0|UNPROVEN|may swim: 0.150 ± 0.003 body lengths/s more than a resting body; but it moves 0.7 ± 0.3 times as far in vacuum",
            "0.3|0.1|0.7|0.0|UNPROVEN|may swim: 0.150 ± 0.003 body lengths/s more than a resting body; but it moves 0.4 ± 0.3 times as far in vacuum",
            "0.3|0.01|0.3|0.1|UNPROVEN|may swim: 0.150 ± 0.003 body lengths/s more than a resting body; but without the acceleration clamp 41 % ± 27 % "
                    + "of its way is left",
            "0.0|0.1|0.2|0.05|DOES_NOT_SWIM|does not swim: the acceleration clamp moves it; without, 28 % of its way is left"})
    void whatIsNotKnownWellDecidesNothing(double vacuum, double vacuumFrom, double clampOff, double clampOffFrom,
            Verdict.Kind kind, String text) {
        Controls controls = Winners.controls(sample(0.74, 0.01)).with(to -> to.vacuum(sample(vacuum, vacuumFrom))
                .clampOff(sample(clampOff, clampOffFrom)).halfStep(sample(0.7, 0)).mirrored(sample(0.74, 0)));

        assertThat(ControlVerdict.of(controls, null).text()).isEqualTo(text);
        assertThat(ControlVerdict.of(controls, null).kind()).isEqualTo(kind);
    }

    /** Half the spacing is another water: what swims is to swim there as well, where that is known. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "-0.19|SWIMS|; at half the spacing it has 81 % of its speed",
            "-0.7|UNPROVEN|; but at half the spacing it has 30 % of its speed",
            "0.6|UNPROVEN|; but at half the spacing it has 160 % of its speed",
            "|UNPROVEN|; but at half the spacing no run is stable"})
    void halfTheSpacingHasItsSay(Double change, Verdict.Kind kind, String text) {
        Convergence.Value none = new Convergence.Value(0.15, 0.01);
        Convergence convergence = new Convergence(Winners.GAIT, null, 1.25,
                List.of(new Convergence.Level("base", 4, 0, none, none, null),
                        new Convergence.Level("spacing/2", change == null ? 0 : 4,
                                change == null ? 4 : 0, none, none,
                                change == null ? null : new Convergence.Value(change, 0.01))),
                null);

        ControlVerdict verdict = ControlVerdict.of(Winners.controls(sample(0.74, 0.01)), convergence);

        assertThat(verdict.text()).endsWith(text);
        assertThat(verdict.kind()).isEqualTo(kind);
    }

    /** As the verdict on a run by itself does; 0.5 body lengths are 0.625. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "0.74|completed|SWIMS|swims: 0.150 ± 0.003 body lengths/s more than a resting body, not in vacuum",
            "0.74|touched-plane|SWIMS|swims: 0.150 ± 0.003 body lengths/s more than a resting body, until it touches a wall, not in vacuum",
            "0.60|touched-plane|UNPROVEN|may swim: 0.122 ± 0.003 body lengths/s more than a resting body, until it touches a wall; but the wall is "
                    + "nearer than 0.5 body lengths"})
    void aWallIsTold(double way, String stopped, Verdict.Kind kind, String text) {
        Controls controls = Winners.controls(sample(way, 0.01, stopped));

        assertThat(ControlVerdict.of(controls, null).text()).startsWith(text);
        assertThat(ControlVerdict.of(controls, null).kind()).isEqualTo(kind);
    }

    /** The length of its body is known, though it is the unit. */
    @ParameterizedTest
    @CsvSource({"0.74, 0.188 ± 0.004 body lengths/s more", "0.40, nearer than 0.5 body lengths",
            "0.01, body lengths further"})
    void aBodyOfLengthOneIsMeasuredByItself(double way, String text) {
        Controls controls = Winners.controls(sample(way, 0.01, "touched-plane")).withBodyLength(1.0);

        assertThat(ControlVerdict.of(controls, null).text()).contains(text).doesNotContain("units");
    }

    /** Where there is a GPU it must swim on that too; a program without clamp or water is not asked for them. */
    @ParameterizedTest
    @CsvSource({"0.7, SWIMS, on cuda (95 %)", "0.1, UNPROVEN, on cuda 15 % of its way is left"})
    void theOtherBackendCounts(double distance, Verdict.Kind kind, String text) {
        Controls controls = Winners.controls(sample(0.74, 0.01)).with(to -> to.bodyLength(null)
                .halfStep(sample(0.7, 0)).mirrored(sample(0.7, 0)).otherBackend(sample(distance, 0)).backend("cuda"));

        assertThat(ControlVerdict.of(controls, null).kind()).isEqualTo(kind);
        assertThat(ControlVerdict.of(controls, null).text()).contains(text).contains("0.188 ± 0.004 units/s")
                .doesNotContain("clamp");
    }
}
