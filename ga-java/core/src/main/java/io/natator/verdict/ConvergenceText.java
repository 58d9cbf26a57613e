package io.natator.verdict;

import io.natator.base.Numbers;
import io.natator.checkpoint.Convergence;
import io.natator.protocol.FinerLevel;
import java.util.List;
import java.util.function.DoubleUnaryOperator;
import java.util.stream.Collectors;

/** How far a winner's speed depends on time step and spacing, in words; after each ± stands a standard error. */
public final class ConvergenceText {

    private ConvergenceText() {
    }

    /** On one line: whether the speed is converged, what it goes to, and by how much each finer level changes it. */
    public static String of(Convergence convergence) {
        String changes = finer(convergence).stream().map(level -> change(level, convergence))
                .collect(Collectors.joining(", "));
        return verdict(convergence) + ": "
                + (convergence.estimate() == null ? changes : speed(convergence) + ", from " + changes);
    }

    private static List<Convergence.Level> finer(Convergence convergence) {
        return convergence.levels().subList(Math.min(1, convergence.levels().size()), convergence.levels().size());
    }

    /** What follows from the errors: more than the means alone are not said to show anything. */
    private static String verdict(Convergence convergence) {
        if (speedMayBeNone(convergence)) {
            return "no speed that could be told from none";
        }
        List<Convergence.Level> finer = finer(convergence);
        if (finer.stream().anyMatch(level -> reach(level, -Limit.SURE) > Limit.CONVERGED)) {
            return "not converged";
        }
        return finer.stream().allMatch(level -> reach(level, Limit.SURE) <= Limit.CONVERGED)
                ? "converged to within 10 %" : "not known whether converged";
    }

    /** How large a level's change may be, or has to be, as a share; nothing is known where it has none or no error. */
    private static double reach(Convergence.Level level, double errors) {
        boolean known = level.change() != null && level.change().error() != null;
        return known ? Math.abs(level.change().mean()) + errors * level.change().error() : Double.NaN;
    }

    private static boolean speedMayBeNone(Convergence convergence) {
        Convergence.Value base = baseSpeed(convergence);
        return base != null
                && (base.mean() == 0 || base.error() != null && Math.abs(base.mean()) <= Limit.SURE * base.error());
    }

    private static Convergence.Value baseSpeed(Convergence convergence) {
        return convergence.levels().isEmpty() ? null : convergence.levels().get(0).speed();
    }

    private static String speed(Convergence convergence) {
        return inLengths(convergence.estimate().speed(), convergence.estimate().error(), convergence)
                + " at time step and spacing 0";
    }

    private static String change(Convergence.Level level, Convergence convergence) {
        String where = " at " + FinerLevel.of(level.level()).words();
        String unstable = level.unstable() == 0 ? "" : " (" + Numbers.count(level.unstable(), "run") + " unstable)";
        return changeAlone(level, convergence) + where + unstable;
    }

    /** A share of the speed, or where that may be none, a speed. */
    private static String changeAlone(Convergence.Level level, Convergence convergence) {
        if (speedMayBeNone(convergence) && level.speed() != null) {
            Convergence.Value base = baseSpeed(convergence);
            Double error = base.error() == null || level.speed().error() == null ? null
                    : Double.valueOf(Math.hypot(base.error(), level.speed().error()));
            return inLengths(level.speed().mean() - base.mean(), error, convergence) + " more";
        }
        return level.change() == null ? "no speed"
                : withError(level.change().mean(), level.change().error(), share -> 100 * share, 1) + " %";
    }

    private static String inLengths(double speed, Double error, Convergence convergence) {
        Verdict.Length length = Verdict.Length.of(convergence.bodyLength());
        return withError(speed, error, one -> one / length.unit(), 3) + " " + length.name() + "/s";
    }

    /** Value and error in other units; a single run has no known error. */
    private static String withError(double value, Double error, DoubleUnaryOperator units, int decimals) {
        double shown = units.applyAsDouble(value);
        return error == null ? Numbers.fixed(shown, decimals) + " ± ?"
                : Numbers.withError(shown, units.applyAsDouble(error), decimals);
    }
}
