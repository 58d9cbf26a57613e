package io.natator.study;

import io.natator.plot.Picture;
import java.awt.BasicStroke;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.function.ToDoubleFunction;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.XYSeries;
import org.knowm.xchart.style.Styler;
import org.knowm.xchart.style.markers.SeriesMarkers;

/** Our speeds against those of Flex, with one standard deviation to each side; equal speeds lie on the diagonal. */
final class ComparisonChart {

    private static final int SIZE = 760;
    private static final Color[] COLOURS = {new Color(0x1f77b4), new Color(0xd62728)};

    private final XYChart chart;

    private ComparisonChart(String title) {
        chart = new XYChartBuilder().width(SIZE).height(SIZE).title(title).xAxisTitle("NVIDIA Flex 1.2.0 (units/s)")
                .yAxisTitle("Natator (units/s)").build();
        chart.getStyler().setLegendPosition(Styler.LegendPosition.InsideNW).setChartBackgroundColor(Color.WHITE);
    }

    /**
     * Draws the comparisons of all intervals into {@code name.png}.
     *
     * @param comparisons at least one
     * @throws IOException if a file cannot be written
     */
    static void draw(String title, List<Comparison> comparisons, Path folder, String name) throws IOException {
        ComparisonChart drawing = new ComparisonChart(title);
        drawing.addDiagonal(comparisons);
        for (Interval interval : Interval.values()) {
            drawing.add(interval, comparisons.stream().filter(one -> one.interval() == interval).toList());
        }
        Picture.save(drawing.chart, folder.resolve(name));
    }

    private void addDiagonal(List<Comparison> comparisons) {
        double[] ends = comparisons.stream().flatMap(one -> List.of(one.flex().mean(), one.ours().mean()).stream())
                .mapToDouble(Double::doubleValue).sorted().toArray();
        double[] line = {ends[0], ends[ends.length - 1]};
        XYSeries diagonal = chart.addSeries("equal", line, line);
        diagonal.setMarker(SeriesMarkers.NONE).setLineColor(Color.GRAY).setLineWidth(1);
    }

    private void add(Interval interval, List<Comparison> comparisons) {
        if (comparisons.isEmpty()) {
            return;
        }
        Color colour = COLOURS[interval.ordinal()];
        XYSeries points = chart.addSeries(interval.label(), values(comparisons, one -> one.flex().mean()),
                values(comparisons, one -> one.ours().mean()),
                values(comparisons, one -> shownDeviation(one.ours())));
        points.setXYSeriesRenderStyle(XYSeries.XYSeriesRenderStyle.Scatter).setMarker(SeriesMarkers.CIRCLE)
                .setMarkerColor(colour);
        for (Comparison comparison : comparisons) {
            addHorizontalBar(comparison, colour);
        }
    }

    /** The library draws vertical error bars only. */
    private void addHorizontalBar(Comparison comparison, Color colour) {
        double deviation = shownDeviation(comparison.flex());
        double x = comparison.flex().mean();
        double y = comparison.ours().mean();
        XYSeries bar = chart.addSeries(comparison.variant().name() + comparison.interval(),
                new double[] {x - deviation, x + deviation}, new double[] {y, y});
        bar.setMarker(SeriesMarkers.NONE).setLineColor(colour).setLineStyle(new BasicStroke(1)).setShowInLegend(false);
    }

    /** A single run is drawn without a bar. */
    private static double shownDeviation(Sample sample) {
        return sample.hasSpread() ? sample.standardDeviation() : 0;
    }

    private static double[] values(List<Comparison> comparisons, ToDoubleFunction<Comparison> value) {
        return comparisons.stream().mapToDouble(value).toArray();
    }
}
