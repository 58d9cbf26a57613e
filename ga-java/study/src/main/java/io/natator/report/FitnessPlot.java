package io.natator.report;

import io.natator.checkpoint.RunFolder;
import io.natator.evolution.GenerationSummary;
import io.natator.plot.Drawing;
import io.natator.plot.Picture;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.function.ToDoubleFunction;
import org.knowm.xchart.XYChart;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** The fitness curve: best, mean and median distance against the generation. */
public final class FitnessPlot {

    private static final Logger LOG = LoggerFactory.getLogger(FitnessPlot.class);

    private FitnessPlot() {
    }

    /** Draws the curve of a finished run into its folder; where Java cannot draw, a warning says so. */
    public static void draw(RunFolder run, List<GenerationSummary> history) {
        try {
            // A Java without fonts still has the curve in generations.csv.
            Drawing.orWarn("fitness curve", () -> draw(run.settings().scene() + ", seed " + run.settings().seed(), history, run.plots()));
        } catch (IOException e) {
            LOG.warn("fitness curve not drawn: {}", e.toString());
        }
    }

    /**
     * Draws {@code fitness.png} into a folder.
     *
     * @param title   what the curve shows
     * @param history at least one generation
     * @throws IOException if a file cannot be written
     */
    public static void draw(String title, List<GenerationSummary> history, Path folder) throws IOException {
        XYChart chart = Charts.lines(title, "generation", "distance (scene units)");
        add(chart, "best", history, GenerationSummary::best, 0);
        add(chart, "mean", history, GenerationSummary::mean, 1);
        add(chart, "median", history, GenerationSummary::median, 2);
        Picture.save(chart, folder.resolve("fitness"));
    }

    private static void add(XYChart chart, String name, List<GenerationSummary> history,
            ToDoubleFunction<GenerationSummary> value, int number) {
        double[] x = history.stream().mapToDouble(GenerationSummary::generation).toArray();
        double[] y = history.stream().mapToDouble(value).toArray();
        Charts.addMarked(chart, name, x, y, number);
    }
}
