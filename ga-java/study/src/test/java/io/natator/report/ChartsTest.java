package io.natator.report;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.awt.image.BufferedImage;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYSeries;

class ChartsTest {

    private static final double[] LINE = {0, 1};

    @ParameterizedTest
    @ValueSource(doubles = {0.05, 0.3, 0.8})
    void aChartToScaleHasUnitsOfOneLength(double reach) {
        XYChart chart = Charts.toScale("title", "x", "y", -0.1, 1, reach, it -> Charts.add(it, "line", LINE, LINE, 0, 1f));
        BufferedImage image = new BufferedImage(chart.getWidth(), chart.getHeight(), BufferedImage.TYPE_INT_RGB);
        chart.paint(image.createGraphics(), chart.getWidth(), chart.getHeight());

        double across = chart.getScreenXFromChart(1) - chart.getScreenXFromChart(0);
        double up = (chart.getScreenYFromChart(0) - chart.getScreenYFromChart(0.05)) / 0.05;

        assertThat(up / across).isCloseTo(1, within(0.03));
    }

    /** Whoever sees no colours tells lines by their dashes, and marked ones by their markers too. */
    @Test
    void linesDifferInMoreThanTheirColour() {
        XYChart chart = Charts.lines("title", "x", "y");
        Set<List<Object>> dashes = new HashSet<>();
        Set<Object> markers = new HashSet<>();
        for (int number = 0; number < 8; number++) {
            XYSeries series = Charts.addMarked(chart, "line " + number, LINE, LINE, number);
            float[] dash = series.getLineStyle().getDashArray();
            dashes.add(dash == null ? List.of() : List.of(dash.length, dash[0], dash[1], dash[dash.length - 1]));
            markers.add(series.getMarker());
        }

        assertThat(dashes).hasSize(8);
        assertThat(markers).hasSize(8);
        assertThat(Charts.add(chart, "seed 2", LINE, LINE, 0, 1, 1f).getLineColor()).isEqualTo(Charts.colour(0));
    }
}
