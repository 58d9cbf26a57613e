package io.natator.study.optimizer;

import io.natator.plot.Picture;
import java.awt.BasicStroke;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.IntStream;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.XYSeries;
import org.knowm.xchart.style.Styler;
import org.knowm.xchart.style.markers.SeriesMarkers;

/** Best fitness against evaluations: the median of each optimizer's runs in a band from quartile to quartile. */
final class CurveChart {

    private static final int POINTS = 200;
    private static final Color[] COLOURS = {new Color(0x1f77b4), new Color(0xff7f0e), new Color(0x2ca02c),
        new Color(0x7f7f7f)};
    private static final int BAND_ALPHA = 50;

    private CurveChart() {
    }

    /**
     * Draws a PNG file.
     *
     * @param bands at least one
     * @param file  path without extension
     * @return the PNG file
     * @throws IOException if a file cannot be written
     */
    static Path draw(String title, List<CurveBand> bands, Path file) throws IOException {
        XYChart chart = new XYChartBuilder().width(900).height(560).title(title).xAxisTitle("evaluations")
                .yAxisTitle("best distance so far (scene units)").build();
        chart.getStyler().setLegendPosition(Styler.LegendPosition.OutsideE).setChartBackgroundColor(Color.WHITE);
        chart.getStyler().setYAxisDecimalPattern("0.0###");
        chart.getStyler().setPlotGridLinesStroke(new BasicStroke(0.5f));
        for (int i = 0; i < bands.size(); i++) {
            addBand(chart, bands.get(i), COLOURS[i % COLOURS.length]);
        }
        for (int i = 0; i < bands.size(); i++) {
            addMedian(chart, bands.get(i), COLOURS[i % COLOURS.length]);
        }
        return Picture.save(chart, file);
    }

    /** Lower quartiles there, upper quartiles back. */
    private static void addBand(XYChart chart, CurveBand band, Color colour) {
        int[] places = places(band);
        int count = places.length;
        double[] x = new double[2 * count];
        double[] y = new double[2 * count];
        for (int i = 0; i < count; i++) {
            x[i] = places[i];
            y[i] = band.quantile(places[i], 0.25);
            x[2 * count - 1 - i] = places[i];
            y[2 * count - 1 - i] = band.quantile(places[i], 0.75);
        }
        Color light = new Color(colour.getRed(), colour.getGreen(), colour.getBlue(), BAND_ALPHA);
        XYSeries series = chart.addSeries(band.label() + ", quartiles", x, y);
        series.setXYSeriesRenderStyle(XYSeries.XYSeriesRenderStyle.PolygonArea).setMarker(SeriesMarkers.NONE)
                .setLineColor(light).setFillColor(light).setShowInLegend(false);
    }

    private static void addMedian(XYChart chart, CurveBand band, Color colour) {
        int[] places = places(band);
        double[] x = IntStream.of(places).asDoubleStream().toArray();
        double[] y = IntStream.of(places).mapToDouble(place -> band.quantile(place, 0.5)).toArray();
        chart.addSeries(band.label() + " (" + band.curves().size() + ")", x, y).setMarker(SeriesMarkers.NONE)
                .setLineColor(colour).setLineStyle(new BasicStroke(2f));
    }

    private static int[] places(CurveBand band) {
        int last = band.evaluations();
        return IntStream.rangeClosed(0, POINTS).map(i -> 1 + (int) Math.round((last - 1.0) * i / POINTS)).distinct()
                .toArray();
    }
}
