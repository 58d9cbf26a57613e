package io.natator.verdict;

import io.natator.base.Numbers;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.FreshRuns;
import io.natator.checkpoint.Spread;
import io.natator.checkpoint.SwimSample;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.List;

/**
 * What a verdict on a winner rests on: one thing that was measured, and whether it is as a swimmer's must be.
 *
 * @param name     what was measured
 * @param value    with ± a standard deviation where it is a mean; empty if it was not measured
 * @param expected of a swimmer
 * @param outcome  whether it is so
 */
public record Measure(String name, String value, String expected, Outcome outcome) {

    private static final String HALF = "at least half of its way";

    /** Whether a measure is as expected. */
    public enum Outcome {
        /** It is as expected. */
        HOLDS,
        /** Otherwise. */
        FAILS,
        /** Not known. */
        NOT_MEASURED
    }

    /**
     * All of a winner, the most important first.
     *
     * @param controls what {@code natator check} found, or null
     */
    public static List<Measure> of(BestGait best, Controls controls) {
        Verdict.Length length = Verdict.Length.of(best.bodyLength());
        double unit = length.unit();
        String name = length.name();
        List<Measure> all = new ArrayList<>();
        FreshRuns fresh = best.fresh();
        double way = fresh == null ? best.result().distanceOrZero() : fresh.base().distance().mean();
        String least = "more than " + Limit.MIN_DISTANCE + " " + name;
        if (fresh == null) {
            boolean isKnown = Verdict.isMeasurable(best.vacuum(), best.bodyLength());
            all.add(new Measure("way, one run", Numbers.fixed(way / unit, 2) + " " + name,
                    isKnown ? least : "more than " + Limit.MIN_DISTANCE + " " + Verdict.Length.BODIES,
                    isKnown ? outcome(Verdict.getsFar(way, 0, unit)) : Outcome.NOT_MEASURED));
        } else {
            SwimSample base = fresh.base();
            double error = base.distance().standardError(base.runs());
            all.add(new Measure("way, " + base.runs() + " fresh starts", spread(base.distance(), unit) + " " + name,
                    least + ", by two standard errors", outcome(Verdict.getsFar(way, error, unit))));
        }
        all.add(halfStep(fresh, way, unit, name));
        all.add(vacuum(best.vacuum(), best, way));
        if (fresh != null && fresh.selectionLoss() != null) {
            all.add(new Measure("lost since it was chosen", Numbers.fixed(100 * fresh.selectionLoss(), 1) + " %",
                    "at most "
                            + Math.round(100 * Limit.MAX_LOSS) + " %",
                    outcome(fresh.selectionLoss() <= Limit.MAX_LOSS)));
        }
        all.addAll(controls == null ? List.of(missing("resting muscles", "moves less than the swimmer"),
                missing("mirrored", HALF)) : controls(controls, unit, name));
        return all;
    }

    private static Measure halfStep(FreshRuns fresh, double way, double unit, String name) {
        if (fresh == null || fresh.halfStep() == null) {
            return missing("half the time step", HalfStep.EXPECTED);
        }
        Spread half = fresh.halfStep().distance();
        return new Measure("half the time step", spread(half, unit) + " " + name, HalfStep.EXPECTED,
                outcome(HalfStep.agrees(way, half.mean())));
    }

    /** Compares speeds, since the run without water ends when the one in water did. */
    private static Measure vacuum(SimulationResult vacuum, BestGait best, double way) {
        String expected = "less than half of its speed";
        if (vacuum == null || vacuum.status() != SimulationResult.Status.OK || way == 0) {
            return missing("without water", expected);
        }
        double speed = best.fresh() == null ? best.speed() : best.fresh().base().speed().mean();
        double share = vacuum.speed() / speed;
        return new Measure("without water", Numbers.fixed(100 * share, 0) + " % of its speed", expected,
                outcome(Math.abs(share) < Limit.DRIFT_ONLY));
    }

    private static List<Measure> controls(Controls controls, double unit, String name) {
        List<Measure> all = new ArrayList<>();
        all.add(new Measure("resting muscles", spread(controls.resting().distance(), unit) + " " + name,
                Limit.MIN_DISTANCE + " " + name + " less than the swimmer",
                outcome(controls.net() / unit >= Limit.MIN_DISTANCE)));
        add(all, "mirrored", controls.mirrored(), controls);
        add(all, "without the acceleration clamp", controls.clampOff(), controls);
        add(all, "on " + controls.backend(), controls.otherBackend(), controls);
        if (controls.underWater() != null) {
            all.add(new Measure("share of the body under water", Numbers.fixed(100 * controls.underWater(), 0) + " %",
                    "at least half",
                    outcome(controls.underWater() >= Limit.MIN_LEFT)));
        }
        return all;
    }

    private static void add(List<Measure> all, String name, SwimSample sample, Controls controls) {
        if (sample != null) {
            double left = ControlVerdict.left(sample, controls);
            all.add(new Measure(name, Numbers.fixed(100 * left, 0) + " % of its way", HALF,
                    outcome(left >= Limit.MIN_LEFT)));
        }
    }

    private static Measure missing(String name, String expected) {
        return new Measure(name, "", expected, Outcome.NOT_MEASURED);
    }

    private static Outcome outcome(boolean holds) {
        return holds ? Outcome.HOLDS : Outcome.FAILS;
    }

    private static String spread(Spread spread, double unit) {
        return Numbers.withError(spread.mean() / unit, spread.sd() / unit, 3);
    }
}
