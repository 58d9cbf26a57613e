package io.natator.cli;

import io.natator.config.EvolutionSettings;
import io.natator.encoding.Gait;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.Individual;
import io.natator.run.EvolutionRun;
import io.natator.simulator.SimulationResult;
import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;

/** The best gait of a run, in words. */
final class RunReport {

    private final PrintWriter out;

    RunReport(PrintWriter out) {
        this.out = out;
    }

    void print(EvolutionSettings settings, EvolutionRun.Outcome outcome) {
        EvolutionState state = outcome.state();
        Individual best = state.best();
        if (best == null) {
            out.println("no gait was measured: all " + state.evaluations() + " evaluations were unstable or failed");
            return;
        }
        Gait gait = settings.encoding().forActuators(settings.actuators()).decode(best.genes());
        out.printf(Locale.ROOT, "best gait of %s after %d generations and %d evaluations%n", settings.scene(),
                state.generation(), state.evaluations());
        out.printf(Locale.ROOT, "  frequency   %.4f 1/s%n", gait.frequency());
        out.printf("  amplitude   %s%n", row(gait.amplitude()));
        out.printf("  phase       %s%n", row(gait.phase()));
        out.printf(Locale.ROOT, "  distance    %.4f in %.2f s (%s)%n", best.result().distance(),
                best.result().simulated(), best.result().stopped());
        if (best.result().vacuumDrift() != null) {
            out.printf(Locale.ROOT, "  net         %.4f: %.4f of it is drift, by the same time in vacuum%n",
                    best.result().score(), best.result().vacuumDrift());
        }
        out.printf(Locale.ROOT, "  speed       %.4f units/s%n", best.result().speed());
        printVacuum(outcome.vacuum());
    }

    private void printVacuum(SimulationResult vacuum) {
        if (vacuum == null) {
            return;
        }
        if (vacuum.status() == SimulationResult.Status.OK) {
            out.printf(Locale.ROOT, "  in vacuum   %.4f in %.2f s, %.4f units/s%n", vacuum.distance(),
                    vacuum.simulated(), vacuum.speed());
        } else {
            out.println("  in vacuum   no result: " + (vacuum.error() != null ? vacuum.error() : vacuum.status()));
        }
    }

    static String row(List<Double> values) {
        return values.stream().map(value -> String.format(Locale.ROOT, "%.4f", value))
                .collect(Collectors.joining(" "));
    }
}
