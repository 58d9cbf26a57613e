package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.base.Numbers;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.encoding.GeneRange;
import io.natator.evolution.EvolutionFailedException;
import io.natator.fitness.FitnessEvaluator;
import io.natator.process.Evaluator;
import io.natator.process.SceneInfo;
import io.natator.run.EvolutionRun;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.Locale;

/** What {@code evolve} would do and how long that would take, judged by a few short evaluations. */
record RunPreview(EvolutionSettings settings, ExecutionSettings execution) {

    /**
     * Measures and prints.
     *
     * @param folder where the run would go
     */
    void print(Path folder, PrintWriter out) throws InterruptedException {
        SceneInfo scene = SceneInfo.of(settings.problem().scene(), settings.problem().overrides(),
                execution.simulator());
        ExecutionSettings limited = EvolutionRun.withTimeLimit(execution, settings);
        double duration = settings.problem().duration() != null ? settings.problem().duration() : scene.duration();
        ProgressEstimate estimate = new ProgressEstimate(settings, System::nanoTime);
        out.println(ShowCommand.settings(settings));
        out.printf(Locale.ROOT, "  scene       %s, %s, %.2f s%n", Numbers.count(scene.particles(), "particle"),
                Numbers.count(scene.actuators(), "actuator"), duration);
        out.printf("  genes       %s%n",
                String.join(", ", settings.problem().genome().genes().stream().map(GeneRange::name).toList()));
        out.printf("  evaluations %s%n", estimate.total());
        out.printf(Locale.ROOT, "  simulator   %s, %s, time limit %s each%n",
                execution.mode().name().toLowerCase(Locale.ROOT), execution.mode() == SimulatorMode.BATCH
                        ? "a generation at once"
                        : execution.mode() == SimulatorMode.SPARK ? "as many at once as the cluster can"
                                : execution.workers() + " at once",
                ProgressEstimate.readable(limited.timeout().toSeconds()));
        out.printf("  run folder  %s%n", folder);
        printTime(limited, scene, duration, estimate.expected(), out);
        out.flush();
    }

    /** Measures and prints before a run that begins anyway: what fails here says why when it fails there. */
    void printAnyway(Path folder, PrintWriter out) throws InterruptedException {
        try {
            print(folder, out);
        } catch (InvalidInputException e) {
            out.println("  time        not known");  // refused there in the same words
            out.flush();
        } catch (EvolutionFailedException | IllegalStateException e) {
            out.println("  time        not known: " + e.getMessage());
            out.flush();
        }
    }

    private void printTime(ExecutionSettings limited, SceneInfo scene, double duration, long evaluations,
            PrintWriter out)
            throws InterruptedException {
        int together = execution.trials(settings.search().population());
        try (Evaluator evaluator = Evaluator.open(limited.withCache(null))) {
            double whole = new EvaluationTime(settings, FitnessEvaluator.of(evaluator, settings, scene)).of(together,
                    duration);
            out.printf(Locale.ROOT, "  time        about %s if no evaluation ends early: %d %s %.2f s%n",
                    ProgressEstimate.readable(Math.round(Math.ceil((double) evaluations / together) * whole)),
                    together, together == 1 ? "takes" : "take", whole);
        }
    }
}
