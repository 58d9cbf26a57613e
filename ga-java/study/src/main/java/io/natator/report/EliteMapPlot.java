package io.natator.report;

import io.natator.config.Numbers;
import io.natator.evolution.EliteMap;
import io.natator.plot.Picture;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.IntSummaryStatistics;
import java.util.List;
import java.util.stream.IntStream;
import org.knowm.xchart.HeatMapChart;
import org.knowm.xchart.HeatMapChartBuilder;

/** Draws what the best gait of each kind is worth; kinds without a gait are left white. */
final class EliteMapPlot {

    private static final int DIGITS = 3;

    private EliteMapPlot() {
    }

    /**
     * Draws the map.
     *
     * @param map  with a gait that gets somewhere
     * @param file without its extension
     */
    static Path draw(EliteMap map, Path file) throws IOException {
        HeatMapChart chart = new HeatMapChartBuilder().width(800).height(640).title("the best gait of each kind, by its worth")
                .xAxisTitle("beats per body length, from").yAxisTitle("cost of transport (mass · length/s²), from").build();
        IntSummaryStatistics beats = map.beats();
        IntSummaryStatistics costs = map.costs();
        List<Number[]> cells = new ArrayList<>();
        map.moving().forEach((cell, elite) -> cells.add(
                new Number[] {cell.beats() - beats.getMin(), cell.cost() - costs.getMin(), elite.score()}));
        chart.addSeries("worth", edges(beats), edges(costs), cells);
        chart.getStyler().setRangeColors(new Color[] {new Color(0xdeebf7), new Color(0x6baed6), new Color(0x08306b)});
        chart.getStyler().setChartBackgroundColor(Color.WHITE);
        chart.getStyler().setXAxisLabelRotation(90);
        chart.getStyler().setHeatMapDecimalValueFormatter(worth -> Numbers.significant(worth, DIGITS));
        return Picture.save(chart, file);
    }

    /** Lower ends of the cells between the first and the last. */
    private static List<String> edges(IntSummaryStatistics cells) {
        return IntStream.rangeClosed(cells.getMin(), cells.getMax())
                .mapToObj(cell -> Numbers.significant(EliteMap.edge(cell), DIGITS)).toList();
    }
}
