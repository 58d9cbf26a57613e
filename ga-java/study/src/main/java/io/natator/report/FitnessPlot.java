package io.natator.report;

import io.natator.checkpoint.RunFolder;
import io.natator.evolution.GenerationSummary;
import io.natator.plot.Picture;
import java.awt.BasicStroke;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.function.ToDoubleFunction;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.style.Styler;
import org.knowm.xchart.style.markers.SeriesMarkers;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** The fitness curve: best, mean and median distance against the generation. */
public final class FitnessPlot {

    private static final Logger LOG = LoggerFactory.getLogger(FitnessPlot.class);
    private static final int WIDTH = 900;
    private static final int HEIGHT = 540;

    private FitnessPlot() {
    }

    /** Draws the curve of a finished run into its folder; where Java cannot draw, a warning says so. */
    public static void draw(RunFolder run, List<GenerationSummary> history) {
        try {
            draw(run.settings().scene() + ", seed " + run.settings().seed(), history, run.plots());
        } catch (IOException | LinkageError e) {
            // A Java without its graphics libraries (or fonts) still has the curve in generations.csv.
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
        XYChart chart = new XYChartBuilder().width(WIDTH).height(HEIGHT).title(title).xAxisTitle("generation")
                .yAxisTitle("distance (scene units)").build();
        chart.getStyler().setLegendPosition(Styler.LegendPosition.OutsideE).setChartBackgroundColor(Color.WHITE);
        chart.getStyler().setPlotGridLinesStroke(new BasicStroke(0.5f));
        add(chart, "best", history, GenerationSummary::best);
        add(chart, "mean", history, GenerationSummary::mean);
        add(chart, "median", history, GenerationSummary::median);
        Picture.save(chart, folder.resolve("fitness"));
    }

    private static void add(XYChart chart, String name, List<GenerationSummary> history,
            ToDoubleFunction<GenerationSummary> value) {
        double[] x = history.stream().mapToDouble(GenerationSummary::generation).toArray();
        double[] y = history.stream().mapToDouble(value).toArray();
        chart.addSeries(name, x, y).setMarker(SeriesMarkers.CIRCLE);
    }
}
