package io.natator.plot;

import java.util.DoubleSummaryStatistics;
import java.util.stream.DoubleStream;
import org.knowm.xchart.XYChart;

/** Logarithmic axes that end at powers of ten: only these have labels. */
final class LogAxes {

    private LogAxes() {
    }

    /**
     * Makes both axes logarithmic and wide enough for some points; without any they are left to the chart.
     *
     * @param x all positive
     * @param y all positive
     */
    static void fit(XYChart chart, DoubleStream x, DoubleStream y) {
        DoubleSummaryStatistics ofX = x.summaryStatistics();
        DoubleSummaryStatistics ofY = y.summaryStatistics();
        chart.getStyler().setXAxisLogarithmic(true).setYAxisLogarithmic(true);
        if (ofX.getCount() > 0) {
            chart.getStyler().setXAxisMin(decadeBelow(ofX.getMin())).setXAxisMax(10 * decadeBelow(ofX.getMax()))
                    .setYAxisMin(decadeBelow(ofY.getMin())).setYAxisMax(10 * decadeBelow(ofY.getMax()));
        }
    }

    private static double decadeBelow(double value) {
        return Math.pow(10, Math.floor(Math.log10(value)));
    }
}
