package io.natator.plot;

import io.natator.config.InvalidInputException;
import java.awt.BasicStroke;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.XYSeries;
import org.knowm.xchart.style.Styler;
import org.knowm.xchart.style.markers.Marker;
import org.knowm.xchart.style.markers.SeriesMarkers;

/** Run time against path error, one picture per scene, with the Pareto front of each scheme. */
public final class PrecisionPlot {

    private static final String ERROR = "path_error_0.25";
    private static final List<String> COLUMNS = List.of("scene", "scheme", "precision", "status", "run_time", ERROR);
    private static final Map<String, Color> COLOURS =
            Map.of("flex", new Color(0xd62728), "conserving", new Color(0x1f77b4));
    private static final Map<String, Marker> MARKERS =
            Map.of("float", SeriesMarkers.CIRCLE, "double", SeriesMarkers.DIAMOND);

    private final XYChart chart;

    private PrecisionPlot(String scene) {
        chart = new XYChartBuilder().width(900).height(600)
                .title(scene + ": run time of 0.25 s against path error").xAxisTitle("run time (s)")
                .yAxisTitle("path error at 0.25 s (scene units)").build();
        chart.getStyler().setLegendPosition(Styler.LegendPosition.OutsideE).setChartBackgroundColor(Color.WHITE);
        chart.getStyler().setPlotGridLinesStroke(new BasicStroke(0.5f));
    }

    /**
     * Draws {@code precision-SCENE.png} into a folder for each scene of a study.
     *
     * @param csv what {@code natator-sim bench precision} wrote
     * @return the PNG files
     * @throws IOException           if a picture cannot be written
     * @throws InvalidInputException if the CSV cannot be used
     */
    public static List<Path> draw(Path csv, Path folder) throws IOException {
        ResultTable table = ResultTable.read(csv, COLUMNS).where("status", "ok");
        List<Path> pictures = new ArrayList<>();
        for (String scene : table.distinct("scene")) {
            PrecisionPlot plot = new PrecisionPlot(scene);
            ResultTable runs = table.where("scene", scene);
            List<ParetoFront.Point> points = points(runs);
            LogAxes.fit(plot.chart, points.stream().mapToDouble(ParetoFront.Point::cost),
                    points.stream().mapToDouble(ParetoFront.Point::error));
            for (String scheme : runs.distinct("scheme")) {
                plot.add(scheme, runs.where("scheme", scheme));
            }
            pictures.add(Picture.save(plot.chart, folder.resolve("precision-" + scene)));
        }
        return pictures;
    }

    private void add(String scheme, ResultTable runs) {
        Color colour = COLOURS.getOrDefault(scheme, Color.DARK_GRAY);
        for (String precision : runs.distinct("precision")) {
            List<ParetoFront.Point> points = points(runs.where("precision", precision));
            if (!points.isEmpty()) {
                addSeries(scheme + " " + precision, points, colour)
                        .setXYSeriesRenderStyle(XYSeries.XYSeriesRenderStyle.Scatter)
                        .setMarker(MARKERS.getOrDefault(precision, SeriesMarkers.SQUARE));
            }
        }
        List<ParetoFront.Point> front = ParetoFront.of(points(runs));
        if (!front.isEmpty()) {
            addSeries(scheme + ", Pareto front", front, colour).setMarker(SeriesMarkers.NONE);
        }
    }

    private XYSeries addSeries(String name, List<ParetoFront.Point> points, Color colour) {
        XYSeries series = chart.addSeries(name, points.stream().mapToDouble(ParetoFront.Point::cost).toArray(),
                points.stream().mapToDouble(ParetoFront.Point::error).toArray());
        series.setMarkerColor(colour).setLineColor(colour).setLineStyle(new BasicStroke(1.5f));
        return series;
    }

    /** What has a place on logarithmic axes: a setting equal to the reference has no error. */
    private static List<ParetoFront.Point> points(ResultTable runs) {
        return runs.rows().stream()
                .map(row -> new ParetoFront.Point(runs.number(row, "run_time"), runs.number(row, ERROR)))
                .filter(point -> point.cost() > 0 && point.error() > 0).toList();
    }
}
