package io.natator.cli;

import io.natator.checkpoint.Environment;
import io.natator.checkpoint.RunFolder;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.encoding.Gait;
import io.natator.evolution.Evolution;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.Individual;
import io.natator.report.FitnessPlot;
import io.natator.simulator.ProcessSimulator;
import io.natator.simulator.RequestRejectedException;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import io.natator.simulator.Simulator;
import io.natator.simulator.WorkerPool;
import java.io.IOException;
import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Carries out the evolution of a run folder from wherever it stands, to the report of the best gait. */
final class EvolutionRun {

    private static final Logger LOG = LoggerFactory.getLogger(EvolutionRun.class);
    private static final String THESIS_SCENES = "thesis/creature-[1-4]";

    private final RunFolder folder;
    private final EvolutionSettings settings;
    private final ExecutionSettings execution;
    private final PrintWriter out;
    private final PrintWriter err;

    EvolutionRun(RunFolder folder, ExecutionSettings execution, PrintWriter out, PrintWriter err) {
        this.folder = folder;
        this.settings = folder.settings();
        this.execution = execution;
        this.out = out;
        this.err = err;
    }

    void run() throws InterruptedException {
        folder.write(Environment.present(execution));
        Thread hint = new Thread(() -> err.println("interrupted; continue by: natator evolve --resume "
                + folder.directory()), "resume-hint");
        Runtime.getRuntime().addShutdownHook(hint);
        try (Simulator simulator = new ProcessSimulator(execution)) {
            EvolutionState state = evolve(simulator);
            SimulationResult vacuum = inVacuum(state.best(), simulator);
            folder.writeResults(state, vacuum);
            draw(state);
            report(state, vacuum);
        } finally {
            removeHook(hint);
        }
    }

    private EvolutionState evolve(Simulator simulator) {
        try (WorkerPool pool = new WorkerPool(simulator, execution.workers());
                Progress progress = new Progress(settings, err, System.console() != null)) {
            return new Evolution(settings, pool, List.of(folder, progress), folder.unfinishedGeneration())
                    .run(folder.checkpoint());
        }
    }

    /** What the best gait does without water, where there is such a scene: a gait that advances there is no swimming. */
    private SimulationResult inVacuum(Individual best, Simulator simulator) throws InterruptedException {
        if (best == null || !settings.scene().matches(THESIS_SCENES)) {
            return null;
        }
        SimulationRequest request = new SimulationRequest(best.result().id(), settings.scene() + "-vacuum",
                gait(best), settings.duration(), settings.scheme(), settings.overrides());
        try {
            return simulator.evaluate(request);
        } catch (RequestRejectedException e) {
            return SimulationResult.failed(request.id(), e.getMessage());
        }
    }

    private Gait gait(Individual individual) {
        return settings.encoding().forActuators(settings.actuators()).decode(individual.genes());
    }

    private void draw(EvolutionState state) {
        try {
            FitnessPlot.draw(settings.scene() + ", seed " + settings.seed(), state.history(), folder.plots());
        } catch (IOException | LinkageError e) {
            // A Java without its graphics libraries (or fonts) still has the curve in generations.csv.
            LOG.warn("fitness curve not drawn: {}", e.toString());
        }
    }

    private void report(EvolutionState state, SimulationResult vacuum) {
        Individual best = state.best();
        if (best == null) {
            out.println("no gait was measured: all " + state.evaluations() + " evaluations were unstable or failed");
        } else {
            Gait gait = gait(best);
            out.printf(Locale.ROOT, "best gait of %s after %d generations and %d evaluations%n", settings.scene(),
                    state.generation(), state.evaluations());
            out.printf(Locale.ROOT, "  frequency   %.4f 1/s%n", gait.frequency());
            out.printf("  amplitude   %s%n", row(gait.amplitude()));
            out.printf("  phase       %s%n", row(gait.phase()));
            out.printf(Locale.ROOT, "  distance    %.4f in %.2f s (%s)%n", best.result().distance(),
                    best.result().simulated(), best.result().stopped());
            out.printf(Locale.ROOT, "  speed       %.4f units/s%n", best.result().speed());
            reportVacuum(vacuum);
        }
        out.println("  run folder  " + folder.directory());
        out.flush();
    }

    private void reportVacuum(SimulationResult vacuum) {
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

    private static String row(List<Double> values) {
        return values.stream().map(value -> String.format(Locale.ROOT, "%.4f", value))
                .collect(Collectors.joining(" "));
    }

    private static void removeHook(Thread hook) {
        try {
            Runtime.getRuntime().removeShutdownHook(hook);
        } catch (IllegalStateException e) {
            // The virtual machine is shutting down; the hook is what tells how to continue.
        }
    }
}
