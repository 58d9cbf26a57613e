package io.natator.verdict;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.SwimSample;
import io.natator.protocol.Results;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class VerdictTest {

    private static final double LENGTH = Winners.LENGTH;

    private static SimulationResult result(double distance, String stopped, double simulated, String scheme) {
        return Results.ok(distance).with(to -> to.stopped(stopped).simulated(simulated).scheme(scheme));
    }

    /** Of one run. */
    private static Verdict verdict(SimulationResult water, SimulationResult vacuum, Double length) {
        return Verdict.of(Winners.best("pool/creature-1", water, length, vacuum, null));
    }

    /** Distances in scene units; in the last line the run in vacuum took longer than the one that touched a wall. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "conserving|0.75|completed|4|0.0000001|4|SWIMS|swims: 0.15 body lengths/s, 0.00 in vacuum",
            "lattice|0.75|completed|4|0.0000001|4|SWIMS|swims: 0.15 body lengths/s, 0.00 in vacuum",
            "conserving|0.75|completed|4|-0.001|4|SWIMS|swims: 0.15 body lengths/s, 0.00 in vacuum",
            "conserving|0.06|completed|4|0|4|DOES_NOT_SWIM|does not swim: moves 0.048 body lengths in 4.00 s, less than 0.05",
            "conserving|-0.001|completed|4|0|4|DOES_NOT_SWIM|does not swim: moves -0.001 body lengths in 4.00 s, less than 0.05",
            "conserving|-0.75|completed|4|0|4|DOES_NOT_SWIM|does not swim forwards: -0.15 body lengths/s, 0.00 in vacuum",
            "conserving|0.2|no-progress|3|0|3|DOES_NOT_SWIM|does not swim: comes to rest, no progress at 3.00 s",
            "conserving|2.5|touched-plane|2|0|2|SWIMS|swims: 1.00 body lengths/s, 0.00 in vacuum, until it touches a wall at 2.00 s",
            "conserving|0.5|touched-plane|1|0|1|UNPROVEN|not judged: 0.40 body lengths/s, 0.00 in vacuum, until it touches a wall at 1.00 s",
            "flex|0.75|completed|4|0.01|4|UNPROVEN|may swim: 0.15 body lengths/s, 0.00 in vacuum; no proof, since scheme flex does not keep momentum",
            "flex|0.75|completed|4|0.3|4|UNPROVEN|may swim: 0.15 body lengths/s, 0.06 in vacuum; moves 0.4 times as far in vacuum",
            "flex|0.75|completed|4|-0.3|4|UNPROVEN|may swim: 0.15 body lengths/s, -0.06 in vacuum; moves 0.4 times as far in vacuum, the other way",
            "flex|1.5|completed|4|7.5|4|DOES_NOT_SWIM|does not swim: moves 5.0 times as far in vacuum",
            "flex|0.6|completed|4|-0.66|4|DOES_NOT_SWIM|does not swim: moves 1.1 times as far in vacuum, the other way",
            "flex|-0.6|completed|4|-9|4|DOES_NOT_SWIM|does not swim: moves 15 times as far in vacuum",
            "flex|0.5|touched-plane|1|4|4|DOES_NOT_SWIM|does not swim: moves 2.0 times as fast in vacuum"})
    void judgesByDistancesTheirSignsAndTheirTimes(String scheme, double water, String stopped, double simulated,
            double vacuum, double inVacuum, Verdict.Kind kind, String text) {
        Verdict verdict = verdict(result(water, stopped, simulated, scheme),
                result(vacuum, "completed", inVacuum, scheme), LENGTH);

        assertThat(verdict.text()).isEqualTo(text);
        assertThat(verdict.kind()).isEqualTo(kind);
        assertThat(verdict.advice() == null).isEqualTo(kind == Verdict.Kind.SWIMS);
    }

    /** By four fresh runs of 4 s each; distances of all at the time step, their mean at half of it. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "0.7 0.8 0.7 0.8|completed|0.7|SWIMS|swims: 0.15 ± 0.01 body lengths/s, 0.14 at half the time step, 0.00 in vacuum",
            "0.7 0.8 0.7 0.8|completed|0.3|UNPROVEN|may swim: 0.15 ± 0.01 body lengths/s, 0.06 at half the time step, 0.00 in vacuum; "
                    + "it loses more than half at half the time step",
            "0.7 0.8 0.7 0.8|completed|1.2|UNPROVEN|may swim: 0.15 ± 0.01 body lengths/s, 0.24 at half the time step, 0.00 in vacuum; "
                    + "it gets more than half as far again at half the time step",
            "0.7 0.8 0.7 0.8|completed|1.1|SWIMS|swims: 0.15 ± 0.01 body lengths/s, 0.22 at half the time step, 0.00 in vacuum",
            "1.9 -0.4 -0.2 0.1|completed|0.4|UNPROVEN|may swim: 0.07 ± 0.21 body lengths/s, 0.08 at half the time step, 0.00 in "
                    + "vacuum; the runs differ too much to tell",
            "0.1 0.0 0.0 0.0|completed|0.1|DOES_NOT_SWIM|does not swim: moves 0.020 ± 0.040 body lengths in 4.00 s, less than 0.05",
            "2.5 2.5 2.5 2.5|touched-plane|2.5|SWIMS|swims: 0.50 ± 0.00 body lengths/s, 0.50 at half the time step, 0.00 in "
                    + "vacuum, until it touches a wall"})
    void freshRunsJudge(String distances, String stopped, double half, Verdict.Kind kind, String text) {
        List<SimulationResult> runs = Arrays.stream(distances.split(" "))
                .map(one -> result(Double.parseDouble(one), stopped, 1, "conserving")).toList();
        SwimSample atHalf = Winners.sample(List.of(result(half, stopped, 1, "conserving")));
        BestGait best = Winners.best(Winners.fresh(Winners.sample(runs), atHalf, 9, 1.0), 0);

        assertThat(Verdict.of(best).text()).isEqualTo(text);
        assertThat(Verdict.of(best).kind()).isEqualTo(kind);
        assertThat(Verdict.of(best).advice() == null).isEqualTo(kind == Verdict.Kind.SWIMS);
        assertThat(FreshText.of(best).get("selected"))
                .isEqualTo("9.0000 by one run, 1.0000 again: selection loss 88.9 %");
    }

    /** One run that broke a law of mechanics is enough: the others do not swim for it. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {"1|0|; 1 of 4 runs was unstable", "2|0|; 2 of 4 runs were unstable",
            "0|1|; 1 of 4 runs was unstable at half the time step", "0|0|''"})
    void noVerdictByTheOtherRunsOfAGaitThatWasUnstable(int base, int half, String doubt) {
        BestGait best = Winners.best(Winners.fresh(runs(base), runs(half), 9, 1.0), 0);

        assertThat(Verdict.of(best).text()).endsWith("in vacuum" + doubt);
        assertThat(Verdict.of(best).kind()).isEqualTo(doubt.isEmpty() ? Verdict.Kind.SWIMS : Verdict.Kind.UNPROVEN);
    }

    /** Nor by any condition of the controls. */
    @ParameterizedTest
    @CsvSource({"0, ''", "1, ' at rest'", "2, ' in vacuum'", "3, ' at half the time step'", "4, ' mirrored'",
            "5, ' on cuda'", "-1,"})
    void noVerdictOfControlsBesideAnUnstableOne(int which, String where) {
        boolean still = which == 1 || which == 2;
        SwimSample doubted = still ? Winners.sample(List.of(Results.ok(0), Results.unstable(0, "shape"))) : runs(1);
        ControlVerdict verdict = ControlVerdict.of(Winners.controls(runs(0)).with(to -> {
            to.otherBackend(runs(0)).backend("cuda");
            switch (which) {
                case 0 -> to.water(doubted);
                case 1 -> to.resting(doubted);
                case 2 -> to.vacuum(doubted);
                case 3 -> to.halfStep(doubted);
                case 4 -> to.mirrored(doubted);
                case 5 -> to.otherBackend(doubted);
                default -> {
                }
            }
        }), null);

        if (where == null) {
            assertThat(verdict.kind()).as(verdict.text()).isEqualTo(Verdict.Kind.SWIMS);
        } else {
            assertThat(verdict.kind()).isEqualTo(Verdict.Kind.UNPROVEN);
            assertThat(verdict.text()).contains((still ? "1 of 2" : "1 of 4") + " runs was unstable" + where);
        }
    }

    /** Four runs that go far, so many of them unstable. */
    private static SwimSample runs(int unstable) {
        List<SimulationResult> all = new ArrayList<>();
        for (int i = 0; i < 4; i++) {
            all.add(i < unstable ? Results.unstable(0, "tank") : Results.ok(2.5));
        }
        return Winners.sample(all);
    }

    @Test
    void aCheatIsToldWhatToTry() {
        assertThat(verdict(result(1.5, "completed", 4, "flex"), result(7.5, "completed", 4, "flex"), LENGTH).advice())
                .contains("--scene pool/creature-N", "open-water/creature-N", "--fitness net")
                .as("in the thesis' tank bodies sink in it").doesNotContain("--scheme");
        assertThat(verdict(result(0.01, "completed", 4, "conserving"), null, LENGTH).advice())
                .contains("--generations");
    }

    /** A drift in the thesis' tank is a matter of its scheme, sinking of its water; elsewhere of the search. */
    @ParameterizedTest
    @CsvSource({"thesis/creature-2, conserving, sink", "thesis/creature-2, flex, --fitness net",
            "pool/creature-2, conserving, --generations", "fish.json, conserving, --generations"})
    void whatToTryDependsOnTheScene(String scene, String scheme, String advice) {
        SimulationResult water = result(0.5, "touched-plane", 1, scheme);
        SimulationResult vacuum = result("flex".equals(scheme) ? 2 : 0, "completed", 1, scheme);

        Verdict verdict = Verdict.of(Winners.best(scene, water, LENGTH, vacuum, null));

        assertThat(verdict.advice()).contains(advice);
        assertThat(verdict.text()).isEqualTo(verdict(water, vacuum, LENGTH).text());
    }

    @Test
    void withoutTheBodysLengthSpeedsAreInUnits() {
        assertThat(verdict(result(0.75, "completed", 4, "conserving"), result(0, "completed", 4, "conserving"), null)
                .text()).isEqualTo("swims: 0.19 units/s, 0.00 in vacuum");
    }

    /** The limit is one of body lengths. */
    @ParameterizedTest
    @CsvSource({"0.001, 0.00", "0.75, 0.19"})
    void aRunThatGoesOnIsNotJudgedByUnits(double way, String speed) {
        assertThat(verdict(result(way, "completed", 4, "conserving"), null, null))
                .extracting(Verdict::kind, Verdict::text).containsExactly(Verdict.Kind.UNPROVEN,
                        "not judged: moves at " + speed + " units/s; not run in vacuum yet");
    }

    @Test
    void withoutAResultThereIsNoVerdict() {
        SimulationResult water = result(0.75, "completed", 4, "conserving");
        assertThat(verdict(water, null, LENGTH).text())
                .isEqualTo("not judged: moves at 0.15 body lengths/s; not run in vacuum yet");
        assertThat(verdict(water, SimulationResult.failed(0, "no answer"), LENGTH).text())
                .isEqualTo("not judged: moves at 0.15 body lengths/s; no result in vacuum, no answer");
        assertThat(verdict(Results.unstable(0, "tank"), null, LENGTH).text())
                .isEqualTo("not judged: unstable at 0.50 s (broke law tank)");
        assertThat(verdict(Results.unstable(0, null), null, LENGTH)).extracting(Verdict::kind, Verdict::text)
                .containsExactly(Verdict.Kind.UNPROVEN, "not judged: unstable at 0.50 s");
    }
}
