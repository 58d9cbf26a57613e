package io.natator.plot;

import io.natator.config.InvalidInputException;
import java.awt.BasicStroke;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.stream.DoubleStream;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.XYSeries;
import org.knowm.xchart.style.Styler;
import org.knowm.xchart.style.markers.Marker;
import org.knowm.xchart.style.markers.SeriesMarkers;

/**
 * How near the solver's stages come to what the processor can do: operations per second over operations per byte, under
 * the measured roofs (Williams, Waterman, Patterson: Roofline, 2009). One picture per instruction set.
 */
public final class RooflinePlot {

    private static final List<String> COLUMNS =
            List.of("kind", "name", "scheme", "instruction_set", "gflops", "gbytes_per_second", "intensity");
    private static final double LEAST_INTENSITY = 0.1;
    private static final double MOST_INTENSITY = 10;
    private static final Map<String, Color> COLOURS =
            Map.of("flex", new Color(0xd62728), "conserving", new Color(0x1f77b4));
    private static final List<Marker> MARKERS = List.of(SeriesMarkers.CIRCLE, SeriesMarkers.DIAMOND,
            SeriesMarkers.SQUARE, SeriesMarkers.TRIANGLE_UP, SeriesMarkers.CROSS);

    private RooflinePlot() {
    }

    /**
     * Draws {@code roofline-SET.png} into a folder for each instruction set.
     *
     * @param csv what {@code natator-sim bench roofline} wrote
     * @return the PNG files
     * @throws IOException           if a picture cannot be written
     * @throws InvalidInputException if the CSV cannot be used
     */
    public static List<Path> draw(Path csv, Path folder) throws IOException {
        ResultTable table = ResultTable.read(csv, COLUMNS);
        List<Path> pictures = new ArrayList<>();
        for (String set : table.distinct("instruction_set")) {
            pictures.add(Picture.save(chart(csv, set, table.where("instruction_set", set)),
                    folder.resolve("roofline-" + set)));
        }
        return pictures;
    }

    private static XYChart chart(Path csv, String set, ResultTable table) {
        XYChart chart = new XYChartBuilder().width(900).height(600).title("Roofline, one thread, " + set)
                .xAxisTitle("operations per byte").yAxisTitle("10^9 operations per second").build();
        chart.getStyler().setLegendPosition(Styler.LegendPosition.OutsideE).setChartBackgroundColor(Color.WHITE);
        chart.getStyler().setPlotGridLinesStroke(new BasicStroke(0.5f));
        ResultTable compute = table.where("kind", "compute");
        if (compute.rows().isEmpty()) {
            throw new InvalidInputException(csv + ": has no row of kind compute for " + set);
        }
        double peak = compute.number(compute.rows().get(0), "gflops");
        ResultTable stages = table.where("kind", "stage");
        LogAxes.fit(chart, DoubleStream.of(LEAST_INTENSITY, MOST_INTENSITY * 0.99),
                DoubleStream.concat(DoubleStream.of(1, peak),
                        stages.rows().stream().mapToDouble(row -> stages.number(row, "gflops"))));
        addRoofs(chart, table.where("kind", "bandwidth"), peak);
        addStages(chart, stages);
        return chart;
    }

    private static void addRoofs(XYChart chart, ResultTable bandwidths, double peak) {
        float shade = 0;
        for (List<String> row : bandwidths.rows()) {
            double bandwidth = bandwidths.number(row, "gbytes_per_second");
            double ridge = Math.min(Math.max(peak / bandwidth, LEAST_INTENSITY), MOST_INTENSITY);
            double[] intensity = {LEAST_INTENSITY, ridge, MOST_INTENSITY};
            double[] reached = DoubleStream.of(intensity).map(x -> Math.min(peak, x * bandwidth)).toArray();
            XYSeries line = chart.addSeries(bandwidths.text(row, "name"), intensity, reached);
            line.setMarker(SeriesMarkers.NONE).setLineColor(Color.getHSBColor(0.1f, 0.3f * shade, 0.25f + 0.15f * shade))
                    .setLineStyle(new BasicStroke(2f));
            shade = Math.min(shade + 1, 4);
        }
    }

    private static void addStages(XYChart chart, ResultTable stages) {
        int number = 0;
        for (List<String> row : stages.rows()) {
            XYSeries point = chart.addSeries(stages.text(row, "scheme") + ": " + stages.text(row, "name"),
                    new double[] {stages.number(row, "intensity")}, new double[] {stages.number(row, "gflops")});
            point.setXYSeriesRenderStyle(XYSeries.XYSeriesRenderStyle.Scatter)
                    .setMarker(MARKERS.get(number++ % MARKERS.size()))
                    .setMarkerColor(COLOURS.getOrDefault(stages.text(row, "scheme"), Color.DARK_GRAY));
        }
    }
}
