package io.natator.report;

import io.natator.checkpoint.CompactRun;
import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.StoredRun;
import io.natator.config.EvolutionSettings;
import io.natator.config.WeightedObjective;
import io.natator.evolution.GenerationSummary;
import io.natator.plot.Drawing;
import io.natator.plot.Picture;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.function.ToDoubleFunction;
import org.knowm.xchart.XYChart;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** The fitness curve: best, mean and median distance, or worth by the run's objectives, against the generation. */
public final class FitnessPlot {

    private static final Logger LOG = LoggerFactory.getLogger(FitnessPlot.class);
    private static final String NAME = "fitness";

    private FitnessPlot() {
    }

    /** Draws the curve of a finished run into its folder; where Java cannot draw, a warning says so. */
    public static void draw(RunFolder run, List<GenerationSummary> history) {
        drawOrWarn(run.settings(), history, run.plots());
    }

    /**
     * Draws the curve of a finished run that has none, as after a kill right behind its last generation. Not of one that was made
     * small: of its folder only what was left is wanted.
     */
    public static void drawIfMissing(Path run) {
        Path plots = RunFolder.plots(run);
        if (!CompactRun.isCompact(run) && !Files.exists(plots.resolve(NAME + ".png"))) {
            drawOrWarn(StoredRun.settings(run), StoredRun.state(run).history(), plots);
        }
    }

    private static void drawOrWarn(EvolutionSettings settings, List<GenerationSummary> history, Path folder) {
        try {
            // A Java without fonts still has the curve in generations.csv.
            Drawing.orWarn("fitness curve", () -> draw(settings, history, folder));
        } catch (IOException e) {
            LOG.warn("fitness curve not drawn: {}", e.toString());
        }
    }

    /**
     * Draws {@code fitness.png} into a folder.
     *
     * @param settings of the run
     * @param history  at least one generation
     * @throws IOException if a file cannot be written
     */
    public static void draw(EvolutionSettings settings, List<GenerationSummary> history, Path folder) throws IOException {
        Picture.save(chart(settings, history), folder.resolve(NAME));
    }

    static XYChart chart(EvolutionSettings settings, List<GenerationSummary> history) {
        XYChart chart = Charts.lines(settings.scene() + ", seed " + settings.seed(), "generation", settings.objectives() == null
                ? "distance (scene units)" : "worth by " + WeightedObjective.text(WeightedObjective.leading(settings.objectives())));
        add(chart, "best", history, GenerationSummary::best, 0);
        add(chart, "mean", history, GenerationSummary::mean, 1);
        add(chart, "median", history, GenerationSummary::median, 2);
        return chart;
    }

    private static void add(XYChart chart, String name, List<GenerationSummary> history,
            ToDoubleFunction<GenerationSummary> value, int number) {
        double[] x = history.stream().mapToDouble(GenerationSummary::generation).toArray();
        double[] y = history.stream().mapToDouble(value).toArray();
        Charts.addMarked(chart, name, x, y, number);
    }
}
