package io.natator.verdict;

import io.natator.checkpoint.Convergence;
import io.natator.config.Numbers;
import io.natator.simulator.FinerLevel;
import java.util.function.DoubleUnaryOperator;
import java.util.stream.Collectors;

/** How far a winner's speed depends on time step and spacing, in words; after each ± stands a standard error. */
public final class ConvergenceText {

    private ConvergenceText() {
    }

    /** On one line: what the speed goes to, and by how much each finer level changes it. */
    public static String of(Convergence convergence) {
        String changes = convergence.levels().stream().skip(1).map(ConvergenceText::change).collect(Collectors.joining(", "));
        return convergence.estimate() == null ? changes : speed(convergence) + ", from " + changes;
    }

    private static String speed(Convergence convergence) {
        Verdict.Length length = Verdict.Length.of(convergence.bodyLength());
        Convergence.Estimate estimate = convergence.estimate();
        return withError(estimate.speed(), estimate.error(), speed -> speed / length.unit(), 3) + " " + length.name()
                + "/s at time step and spacing 0";
    }

    private static String change(Convergence.Level level) {
        String where = " at " + FinerLevel.of(level.level()).words();
        String unstable = level.unstable() == 0 ? "" : " (" + Numbers.count(level.unstable(), "run") + " unstable)";
        return (level.change() == null ? "no speed" : withError(level.change().mean(), level.change().error(), share -> 100 * share, 1)
                + " %") + where + unstable;
    }

    /** In other units; one run does not tell its error. */
    private static String withError(double value, Double error, DoubleUnaryOperator units, int decimals) {
        double shown = units.applyAsDouble(value);
        return error == null ? Numbers.fixed(shown, decimals) + " ± ?"
                : Numbers.withError(shown, units.applyAsDouble(error), decimals);
    }
}
