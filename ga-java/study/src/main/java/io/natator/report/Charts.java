package io.natator.report;

import java.awt.BasicStroke;
import java.awt.Color;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.XYSeries;
import org.knowm.xchart.style.Styler;
import org.knowm.xchart.style.markers.SeriesMarkers;

/** The look that all line charts of the reports share. */
public final class Charts {

    /** Colours that are told apart by most people. */
    private static final Color[] COLOURS = {new Color(0x1f77b4), new Color(0xd95f02), new Color(0x1b9e77),
        new Color(0x7570b3), new Color(0xe7298a), new Color(0x666666), new Color(0xa6761d), new Color(0x17becf)};

    private Charts() {
    }

    /** An empty chart. */
    public static XYChart lines(String title, String x, String y) {
        XYChart chart = new XYChartBuilder().width(800).height(480).title(title).xAxisTitle(x).yAxisTitle(y).build();
        chart.getStyler().setLegendPosition(Styler.LegendPosition.OutsideE).setChartBackgroundColor(Color.WHITE);
        chart.getStyler().setYAxisDecimalPattern("0.0###");
        chart.getStyler().setPlotGridLinesStroke(new BasicStroke(0.5f));
        return chart;
    }

    /** One of eight colours. */
    public static Color colour(int number) {
        return COLOURS[number % COLOURS.length];
    }

    /** Adds a line without markers. */
    public static XYSeries add(XYChart chart, String name, double[] x, double[] y, int colour, float width) {
        XYSeries series = chart.addSeries(name, x, y);
        series.setMarker(SeriesMarkers.NONE).setLineColor(colour(colour)).setLineStyle(new BasicStroke(width));
        return series;
    }

    /** Adds a line with markers, and one standard deviation to either side. */
    public static void addWithSpread(XYChart chart, String name, double[] x, double[] y, double[] deviation,
            int colour) {
        XYSeries series = chart.addSeries(name, x, y, deviation);
        series.setMarker(SeriesMarkers.CIRCLE).setMarkerColor(colour(colour)).setLineColor(colour(colour))
                .setLineStyle(new BasicStroke(2f));
    }

    /** Adds a thin line that belongs to an axis of its own, on the right. */
    public static void addOnTheRight(XYChart chart, String name, double[] x, double[] y, String title, Color colour) {
        XYSeries series = chart.addSeries(name, x, y);
        series.setMarker(SeriesMarkers.NONE).setLineColor(colour).setLineStyle(new BasicStroke(1f)).setYAxisGroup(1);
        chart.setYAxisGroupTitle(1, title);
        chart.getStyler().setYAxisGroupPosition(1, Styler.YAxisPosition.Right);
    }
}
