package io.natator.verdict;

import io.natator.base.Numbers;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.Convergence;
import io.natator.checkpoint.SwimSample;
import java.util.ArrayList;
import java.util.List;

/**
 * One verdict from all controls of a winner: it swims if it gets further than a dead body does, by more than chance, in the
 * water, and not by the vacuum's drift, the clamp, the time step, one side of its body, or one backend.
 *
 * @param kind the verdict
 * @param text the same in words, on one line, with what it rests on
 */
public record ControlVerdict(Verdict.Kind kind, String text) {

    /**
     * The verdict on a winner.
     *
     * @param convergence how its speed depends on the spacing, or null if that is not known
     */
    public static ControlVerdict of(Controls controls, Convergence convergence) {
        Verdict.Length length = Verdict.Length.of(controls.bodyLength());
        double unit = length.unit();
        String name = length.name();
        double net = controls.net();
        if (net / unit < Limit.MIN_DISTANCE) {
            return new ControlVerdict(Verdict.Kind.DOES_NOT_SWIM, "does not swim: moves "
                    + Numbers.withError(net / unit, controls.water().distance().sd() / unit, 3) + " " + name
                    + " further than a resting body in " + Numbers.fixed(controls.duration(), 2) + " s, less than "
                    + Limit.MIN_DISTANCE);
        }
        if (drift(controls) - error(controls.vacuum(), controls) >= Limit.MIN_LEFT) {
            return new ControlVerdict(Verdict.Kind.DOES_NOT_SWIM,
                    "does not swim: moves " + Numbers.fixed(drift(controls), 1)
                            + " times as far in vacuum"
                            + (controls.vacuum().distance().mean() < 0 ? ", the other way" : ""));
        }
        SwimSample clampOff = controls.clampOff();
        if (clampOff != null && left(clampOff, controls) + error(clampOff, controls) < Limit.MIN_LEFT) {
            return new ControlVerdict(Verdict.Kind.DOES_NOT_SWIM,
                    "does not swim: the acceleration clamp moves it; without, "
                            + percent(left(clampOff, controls)) + " of its way is left");
        }
        String speed = Numbers.withError(net / controls.duration() / unit, controls.water().speed().sd() / unit, 2)
                + " " + name + "/s more than a resting body";
        String end = controls.water().endsAtWall() ? Verdict.UNTIL_WALL : "";
        Convergence.Level finer = convergence == null ? null : convergence.halfSpacing();
        List<String> doubts = doubts(controls, finer, net, length);
        return doubts.isEmpty()
                ? new ControlVerdict(Verdict.Kind.SWIMS, "swims: " + speed + end + reasons(controls)
                        + (finer == null ? "" : "; " + atHalfSpacing(finer)))
                : new ControlVerdict(Verdict.Kind.UNPROVEN,
                        "may swim: " + speed + end + "; but " + String.join("; ", doubts));
    }

    /** In words, the share of its speed that is left at half the spacing. */
    private static String atHalfSpacing(Convergence.Level level) {
        return "at half the spacing " + (level.change() == null ? "no run is stable"
                : "it has " + percent(1 + level.change().mean()) + " of its speed");
    }

    private static List<String> doubts(Controls controls, Convergence.Level finer, double net, Verdict.Length length) {
        List<String> doubts = new ArrayList<>();
        if (!Verdict.getsFar(net, controls.error(), length.unit())) {
            doubts.add("its runs differ too much to tell");
        }
        if (controls.water().endsAtWall() && controls.water().distance().mean() / length.unit() < Limit.WAY_TO_WALL) {
            doubts.add("the wall is nearer than " + Limit.WAY_TO_WALL + " " + length.name());
        }
        if (drift(controls) + error(controls.vacuum(), controls) >= Limit.MIN_LEFT) {
            doubts.add("it moves " + Numbers.withError(drift(controls), error(controls.vacuum(), controls), 1)
                    + " times as far in vacuum");
        }
        SwimSample clampOff = controls.clampOff();
        if (clampOff != null && left(clampOff, controls) - error(clampOff, controls) < Limit.MIN_LEFT) {
            doubts.add("without the acceleration clamp " + percent(left(clampOff, controls)) + " ± "
                    + percent(error(clampOff, controls)) + " of its way is left");
        }
        if (controls.underWater() != null && controls.underWater() < Limit.MIN_LEFT) {
            doubts.add("it skims: " + percent(controls.underWater()) + " of its body are under water");
        }
        if (!HalfStep.agrees(1, left(controls.halfStep(), controls))) {
            doubts.add("at half the time step it has " + percent(left(controls.halfStep(), controls)) + " of its way");
        }
        unstable(doubts, "", controls.water());
        unstable(doubts, " at rest", controls.resting());
        unstable(doubts, " in vacuum", controls.vacuum());
        unstable(doubts, " without the acceleration clamp", clampOff);
        unstable(doubts, " at half the time step", controls.halfStep());
        unstable(doubts, " mirrored", controls.mirrored());
        unstable(doubts, " on " + controls.backend(), controls.otherBackend());
        doubt(doubts, "mirrored", controls.mirrored(), controls);
        doubt(doubts, "on " + controls.backend(), controls.otherBackend(), controls);
        if (finer != null && (finer.change() == null || !HalfStep.agrees(1, 1 + finer.change().mean()))) {
            doubts.add(atHalfSpacing(finer));
        }
        return doubts;
    }

    /** What breaks laws of mechanics under any condition is not judged by its other runs. */
    private static void unstable(List<String> doubts, String where, SwimSample sample) {
        if (sample != null && sample.unstable() > 0) {
            doubts.add(Verdict.instability(sample) + where);
        }
    }

    private static void doubt(List<String> doubts, String where, SwimSample sample, Controls controls) {
        if (sample != null && left(sample, controls) < Limit.MIN_LEFT) {
            doubts.add(where + " " + percent(left(sample, controls)) + " of its way is left");
        }
    }

    private static String reasons(Controls controls) {
        List<String> where = new ArrayList<>(List.of("not in vacuum"));
        if (controls.clampOff() != null) {
            where.add("without the acceleration clamp (" + percent(left(controls.clampOff(), controls)) + ")");
        }
        where.add("at half the time step (" + percent(left(controls.halfStep(), controls)) + " of its way)");
        where.add("mirrored (" + percent(left(controls.mirrored(), controls)) + ")");
        if (controls.otherBackend() != null) {
            where.add("on " + controls.backend() + " (" + percent(left(controls.otherBackend(), controls)) + ")");
        }
        return ", " + String.join(", ", where)
                + (controls.underWater() == null ? "" : "; " + percent(controls.underWater()) + " under water");
    }

    /** Way in vacuum, either way, as a share of its way in water. */
    private static double drift(Controls controls) {
        return Math.abs(controls.vacuum().distance().mean()) / controls.net();
    }

    /** So much a control's mean is known to, as a share of the way in water. */
    private static double error(SwimSample sample, Controls controls) {
        return Limit.SURE * sample.distance().standardError(sample.runs()) / controls.net();
    }

    /** Share of its way in water, less the dead body's drift in both. */
    static double left(SwimSample sample, Controls controls) {
        return (sample.distance().mean() - controls.resting().distance().mean()) / controls.net();
    }

    private static String percent(double share) {
        return Numbers.fixed(100 * share, 0) + " %";
    }
}
