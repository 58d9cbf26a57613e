package io.natator.cli;

import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.encoding.Encoding;
import io.natator.encoding.GeneRange;
import io.natator.run.EvolutionRun;
import io.natator.simulator.Evaluator;
import io.natator.simulator.SceneInfo;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.stream.LongStream;

/** What {@code evolve} would do and how long that would take, judged by a few short evaluations. */
final class Plan {

    /** Simulated seconds of the trials; their difference leaves out what every evaluation costs once. */
    private static final double SHORT_TRIAL = 0.05;
    private static final double LONG_TRIAL = 0.25;
    private static final double NANOSECONDS = 1e9;

    private final EvolutionSettings settings;
    private final ExecutionSettings execution;

    Plan(EvolutionSettings settings, ExecutionSettings execution) {
        this.settings = settings;
        this.execution = execution;
    }

    /**
     * Measures and prints.
     *
     * @param folder where the run would go
     */
    void print(Path folder, PrintWriter out) throws InterruptedException {
        SceneInfo scene = SceneInfo.of(settings.scene(), settings.overrides(), execution.simulator());
        ExecutionSettings limited = EvolutionRun.withTimeLimit(execution, settings);
        double duration = settings.duration() != null ? settings.duration() : scene.duration();
        Encoding encoding = settings.encoding().forActuators(settings.actuators());
        Pace pace = new Pace(settings, 0, System::nanoTime);
        pace.generationStarted(0, settings.population());
        out.println(ShowCommand.settings(settings));
        out.printf(Locale.ROOT, "  scene       %d particles, %d actuators, %.2f s%n", scene.particles(),
                scene.actuators(), duration);
        out.printf("  genes       %s%n", String.join(", ", encoding.genes().stream().map(GeneRange::name).toList()));
        out.printf("  evaluations about %d%n", pace.expected());
        out.printf(Locale.ROOT, "  simulator   %s, %s, time limit %s each%n",
                execution.mode().name().toLowerCase(Locale.ROOT), execution.mode() == SimulatorMode.BATCH
                        ? "a generation at once" : execution.workers() + " at once",
                Pace.readable(limited.timeout().toSeconds()));
        out.printf("  run folder  %s%n", folder);
        printTime(limited, encoding, duration, pace.expected(), out);
        out.flush();
    }

    private void printTime(ExecutionSettings limited, Encoding encoding, double duration, long evaluations,
            PrintWriter out) throws InterruptedException {
        int together = execution.mode() == SimulatorMode.BATCH ? settings.population() : execution.workers();
        try (Evaluator evaluator = Evaluator.open(limited.withCache(null))) {
            seconds(evaluator, encoding, 1, SHORT_TRIAL);
            double small = seconds(evaluator, encoding, together, SHORT_TRIAL);
            double large = seconds(evaluator, encoding, together, LONG_TRIAL);
            double perSecond = Math.max(large - small, 0) / (LONG_TRIAL - SHORT_TRIAL);
            double whole = small + Math.max(duration - SHORT_TRIAL, 0) * perSecond;
            out.printf(Locale.ROOT, "  time        at most %s: %d evaluations take %.2f s, if none ends early%n",
                    Pace.readable(Math.round(Math.ceil((double) evaluations / together) * whole)), together, whole);
        }
    }

    /** How long a few evaluations take together, of the gait in the middle of all ranges. */
    private double seconds(Evaluator evaluator, Encoding encoding, int count, double duration)
            throws InterruptedException {
        List<Double> middle = encoding.genes().stream().map(range -> (range.lower() + range.upper()) / 2).toList();
        List<SimulationRequest> requests = LongStream.range(0, count)
                .mapToObj(id -> new SimulationRequest(id, settings.scene(), encoding.decode(middle), duration,
                        settings.scheme(), settings.overrides()))
                .toList();
        long start = System.nanoTime();
        evaluator.evaluateAll(requests, result -> {
            if (result.status() == SimulationResult.Status.FAILED) {
                throw new IllegalStateException("a trial evaluation failed: " + result.error());
            }
        });
        return (System.nanoTime() - start) / NANOSECONDS;
    }
}
