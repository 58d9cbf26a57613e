package io.natator.report;

import io.natator.analysis.GenerationSummary;
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

/** The fitness curve: best, mean and median distance against the generation. */
public final class FitnessPlot {

    private static final int WIDTH = 900;
    private static final int HEIGHT = 540;

    private FitnessPlot() {
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
