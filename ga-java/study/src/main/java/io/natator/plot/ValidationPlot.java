package io.natator.plot;

import java.awt.BasicStroke;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.function.ToDoubleFunction;
import java.util.stream.Stream;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.XYSeries;
import org.knowm.xchart.style.Styler;
import org.knowm.xchart.style.markers.Marker;
import org.knowm.xchart.style.markers.SeriesMarkers;

/** What the simulator gives beside what others measured: the front of a collapsing column, the density at rest. */
public final class ValidationPlot {

    private static final List<String> COLUMNS = List.of("part", "scheme", "precision", "substeps", "iterations",
            "status", "run_time", "density_error_mean", "density_error_max");
    private static final List<String> FRONT_COLUMNS =
            List.of("case", "width", "scheme", "precision", "substeps", "iterations", "time", "position");
    private static final String EXPERIMENT = "experiment";
    private static final Map<String, Color> COLOURS =
            Map.of("flex", new Color(0xd62728), "conserving", new Color(0x1f77b4));
    /** For the settings of a scheme in turn: the first is drawn lightest. */
    private static final int[] OPACITIES = {110, 255, 180};
    private static final Marker[] PEER_MARKERS = {SeriesMarkers.SQUARE, SeriesMarkers.TRIANGLE_UP,
        SeriesMarkers.DIAMOND, SeriesMarkers.TRIANGLE_DOWN, SeriesMarkers.CROSS};

    private ValidationPlot() {
    }

    /**
     * Draws {@code validation-front-CASE}, {@code validation-density-mean} and {@code validation-density-max} as
     * PNG files into a folder.
     *
     * @param csv what {@code natator-sim bench validation} wrote; the fronts are in the file beside it
     * @return the PNG files
     * @throws IOException if a picture cannot be written
     * @throws io.natator.config.InvalidInputException if a CSV cannot be used
     */
    public static List<Path> draw(Path csv, Path folder) throws IOException {
        ResultTable table = ResultTable.read(csv, COLUMNS);
        ResultTable fronts = ResultTable.read(frontsBeside(csv), FRONT_COLUMNS);
        List<Path> pictures = new ArrayList<>();
        for (String column : fronts.distinct("case")) {
            XYChart chart = fronts(column, fronts.where("case", column));
            pictures.add(Picture.save(chart, folder.resolve("validation-front-" + column)));
        }
        ResultTable tank = table.where("part", "tank");
        for (String figure : List.of("mean", "max")) {
            if (!tank.rows().isEmpty()) {
                pictures.add(Picture.save(densities(figure, tank), folder.resolve("validation-density-" + figure)));
            }
        }
        return pictures;
    }

    private static Path frontsBeside(Path csv) {
        return csv.resolveSibling(csv.getFileName().toString().replaceFirst("\\.[^.]*$", "") + "-fronts.csv");
    }

    private static XYChart fronts(String column, ResultTable fronts) {
        XYChart chart = chart("front of the collapsing column, " + column, "T = t √(n² g / a)", "Z = x / a");
        chart.getStyler().setXAxisMin(0.0).setYAxisMin(1.0).setLegendPosition(Styler.LegendPosition.InsideNW);
        for (String scheme : fronts.distinct("scheme")) {
            ResultTable ofScheme = fronts.where("scheme", scheme);
            if (scheme.equals(EXPERIMENT)) {
                addSeries(chart, "Martin and Moyce (1952)", ofScheme, column("time"), column("position"), Color.BLACK)
                        .setXYSeriesRenderStyle(XYSeries.XYSeriesRenderStyle.Scatter)
                        .setMarker(SeriesMarkers.CIRCLE);
                continue;
            }
            int shade = 0;
            for (String label : ofScheme.rows().stream().map(row -> label(ofScheme, row)).distinct().toList()) {
                List<List<String>> rows =
                        ofScheme.rows().stream().filter(row -> label(ofScheme, row).equals(label)).toList();
                addSeries(chart, label, new ResultTable(ofScheme.columns(), rows), column("time"), column("position"),
                        shaded(colour(scheme), shade++)).setMarker(SeriesMarkers.NONE);
            }
        }
        return chart;
    }

    private static XYChart densities(String figure, ResultTable tank) {
        XYChart chart = chart("density error of the thesis' tank at rest, " + figure, "wall time of 4 s (s)",
                "max(ρ - 1, 0), " + figure + " (%)");
        chart.getStyler().setLegendPosition(Styler.LegendPosition.OutsideE);
        NumberOf error = column("density_error_" + figure).times(100);
        ResultTable own = tank.where("status", "ok");
        ResultTable peers = tank.where("status", "published");
        List<List<String>> all = Stream.concat(own.rows().stream(), peers.rows().stream()).toList();
        LogAxes.fit(chart, all.stream().mapToDouble(row -> column("run_time").of(tank, row)),
                all.stream().mapToDouble(row -> error.of(tank, row)));
        for (String scheme : own.distinct("scheme")) {
            ResultTable runs = own.where("scheme", scheme);
            List<List<String>> byCost = runs.rows().stream()
                    .sorted(Comparator.comparingDouble(row -> runs.number(row, "run_time"))).toList();
            addSeries(chart, scheme, new ResultTable(runs.columns(), byCost), column("run_time"), error,
                    colour(scheme)).setMarker(SeriesMarkers.CIRCLE);
        }
        int shape = 0;
        for (String peer : peers.distinct("scheme")) {
            addSeries(chart, peer, peers.where("scheme", peer), column("run_time"), error, Color.DARK_GRAY)
                    .setXYSeriesRenderStyle(XYSeries.XYSeriesRenderStyle.Scatter)
                    .setMarker(PEER_MARKERS[shape++ % PEER_MARKERS.length]);
        }
        return chart;
    }

    /** A figure of a row. */
    private interface NumberOf {
        double of(ResultTable table, List<String> row);

        default NumberOf times(double factor) {
            return (table, row) -> factor * of(table, row);
        }
    }

    private static NumberOf column(String name) {
        return (table, row) -> table.number(row, name);
    }

    private static XYChart chart(String title, String x, String y) {
        XYChart chart = new XYChartBuilder().width(900).height(600).title(title).xAxisTitle(x).yAxisTitle(y).build();
        chart.getStyler().setChartBackgroundColor(Color.WHITE);
        chart.getStyler().setPlotGridLinesStroke(new BasicStroke(0.5f));
        return chart;
    }

    private static XYSeries addSeries(XYChart chart, String name, ResultTable table, NumberOf x, NumberOf y,
            Color colour) {
        XYSeries series = chart.addSeries(name, numbers(table, row -> x.of(table, row)),
                numbers(table, row -> y.of(table, row)));
        series.setMarkerColor(colour).setLineColor(colour).setLineStyle(new BasicStroke(1.5f));
        return series;
    }

    private static double[] numbers(ResultTable table, ToDoubleFunction<List<String>> number) {
        return table.rows().stream().mapToDouble(number).toArray();
    }

    /** "conserving 8 × 4 float, 24 wide". */
    private static String label(ResultTable table, List<String> row) {
        return table.text(row, "scheme") + " " + table.text(row, "substeps") + " × " + table.text(row, "iterations")
                + " " + table.text(row, "precision") + ", " + table.text(row, "width") + " wide";
    }

    private static Color colour(String scheme) {
        return COLOURS.getOrDefault(scheme, Color.DARK_GRAY);
    }

    private static Color shaded(Color colour, int shade) {
        return new Color(colour.getRed(), colour.getGreen(), colour.getBlue(), OPACITIES[shade % OPACITIES.length]);
    }
}
