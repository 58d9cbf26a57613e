package io.natator.report;

import io.natator.evolution.EliteMap;
import io.natator.plot.Picture;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.stream.IntStream;
import org.knowm.xchart.HeatMapChart;
import org.knowm.xchart.HeatMapChartBuilder;

/** Draws what the best gait of each kind is worth; kinds without a gait are left white. */
final class EliteMapPlot {

    private EliteMapPlot() {
    }

    /**
     * Draws the map.
     *
     * @param actuators of the creature
     * @param file      without its extension
     */
    static Path draw(EliteMap map, int actuators, Path file) throws IOException {
        HeatMapChart chart = new HeatMapChartBuilder().width(800).height(640).title("the best gait of each kind, by its worth")
                .xAxisTitle("waves on the body").yAxisTitle("beats per second").build();
        double most = EliteMap.mostWaves(actuators);
        List<String> waves = centres(-most, most);
        List<String> beats = centres(0.5, 2.0);
        List<Number[]> cells = new ArrayList<>();
        map.elites().forEach((cell, elite) -> cells.add(new Number[] {cell.wave(), cell.beat(), elite.score()}));
        chart.addSeries("worth", waves, beats, cells);
        chart.getStyler().setRangeColors(new Color[] {new Color(0xdeebf7), new Color(0x6baed6), new Color(0x08306b)});
        chart.getStyler().setChartBackgroundColor(Color.WHITE);
        return Picture.save(chart, file);
    }

    /** Middles of the cells between two ends. */
    private static List<String> centres(double low, double high) {
        return IntStream.range(0, EliteMap.SIDE)
                .mapToObj(i -> String.format(Locale.ROOT, "%.2f", low + (i + 0.5) * (high - low) / EliteMap.SIDE)).toList();
    }
}
