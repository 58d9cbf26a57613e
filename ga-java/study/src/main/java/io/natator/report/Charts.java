package io.natator.report;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.image.BufferedImage;
import java.util.function.Consumer;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.XYSeries;
import org.knowm.xchart.style.Styler;
import org.knowm.xchart.style.markers.Marker;
import org.knowm.xchart.style.markers.SeriesMarkers;

/** The look that all line charts of the reports share. Lines differ in more than their colour: in dashes, or in markers. */
public final class Charts {

    private static final int WIDTH = 800;
    private static final int HEIGHT = 480;
    private static final double LEAST_REACH = 0.12;
    /** Colours that are told apart by most people. */
    private static final Color[] COLOURS = {new Color(0x1f77b4), new Color(0xd95f02), new Color(0x1b9e77),
        new Color(0x7570b3), new Color(0xe7298a), new Color(0x666666), new Color(0xa6761d), new Color(0x17becf)};
    /** Lengths of strokes and gaps by turns, in pixels; the first line has none. */
    private static final float[][] DASHES = {null, {9, 4}, {2, 3}, {9, 3, 2, 3}, {16, 5}, {5, 5}, {9, 3, 2, 3, 2, 3}, {2, 6}};
    private static final Marker[] MARKERS = {SeriesMarkers.CIRCLE, SeriesMarkers.SQUARE, SeriesMarkers.TRIANGLE_UP,
        SeriesMarkers.DIAMOND, SeriesMarkers.CROSS, SeriesMarkers.TRIANGLE_DOWN, SeriesMarkers.PLUS, SeriesMarkers.RECTANGLE};

    private Charts() {
    }

    /** An empty chart. */
    public static XYChart lines(String title, String x, String y) {
        return lines(title, x, y, HEIGHT);
    }

    private static XYChart lines(String title, String x, String y, int height) {
        XYChart chart = new XYChartBuilder().width(WIDTH).height(height).title(title).xAxisTitle(x).yAxisTitle(y).build();
        chart.getStyler().setLegendPosition(Styler.LegendPosition.OutsideE).setChartBackgroundColor(Color.WHITE)
                .setLegendSeriesLineLength(36);
        chart.getStyler().setYAxisDecimalPattern("0.0###");
        chart.getStyler().setPlotGridLinesStroke(new BasicStroke(0.5f));
        return chart;
    }

    /**
     * A chart in which a unit is as long upwards as sideways, so that shapes are what they are.
     *
     * @param from  left end of the horizontal axis
     * @param to    its right end
     * @param range the vertical axis goes from minus this to this, or further, so that there is room for its numbers
     * @param fill  adds what is shown; called twice
     */
    public static XYChart toScale(String title, String x, String y, double from, double to, double range, Consumer<XYChart> fill) {
        double reach = Math.max(range, LEAST_REACH * (to - from));
        int height = HEIGHT;
        for (int round = 0; ; round++) {
            XYChart chart = lines(title, x, y, height);
            chart.getStyler().setXAxisMin(from).setXAxisMax(to).setYAxisMin(-reach).setYAxisMax(reach);
            chart.getStyler().setXAxisDecimalPattern("0.0##").setPlotContentSize(1);
            fill.accept(chart);
            if (round == 1) {
                return chart;
            }
            Graphics2D graphics = new BufferedImage(WIDTH, height, BufferedImage.TYPE_INT_RGB).createGraphics();
            chart.paint(graphics, WIDTH, height);
            graphics.dispose();
            double scale = (chart.getScreenXFromChart(to) - chart.getScreenXFromChart(from)) / (to - from);
            double shown = chart.getScreenYFromChart(-reach) - chart.getScreenYFromChart(reach);
            height += (int) Math.round(2 * reach * scale - shown);
        }
    }

    /** One of eight colours. */
    public static Color colour(int number) {
        return COLOURS[number % COLOURS.length];
    }

    /** Adds a line without markers, in the colour and the dashes of a number. */
    public static XYSeries add(XYChart chart, String name, double[] x, double[] y, int number, float width) {
        return add(chart, name, x, y, number, number, width);
    }

    /** Adds a line without markers whose dashes are those of another number than its colour. */
    public static XYSeries add(XYChart chart, String name, double[] x, double[] y, int colour, int dashes, float width) {
        XYSeries series = chart.addSeries(name, x, y);
        series.setMarker(SeriesMarkers.NONE).setLineColor(colour(colour)).setLineStyle(stroke(dashes, width));
        return series;
    }

    private static BasicStroke stroke(int number, float width) {
        float[] dashes = DASHES[number % DASHES.length];
        return dashes == null ? new BasicStroke(width)
                : new BasicStroke(width, BasicStroke.CAP_BUTT, BasicStroke.JOIN_ROUND, 1, dashes, 0);
    }

    /** Adds a line with the markers of a number. */
    public static XYSeries addMarked(XYChart chart, String name, double[] x, double[] y, int number) {
        XYSeries series = add(chart, name, x, y, number, 2f);
        series.setMarker(marker(number)).setMarkerColor(colour(number));
        return series;
    }

    private static Marker marker(int number) {
        return MARKERS[number % MARKERS.length];
    }
}
