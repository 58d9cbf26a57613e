package io.natator.plot;

import io.natator.config.InvalidInputException;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import org.knowm.xchart.HeatMapChart;
import org.knowm.xchart.HeatMapChartBuilder;

/** The stable region of each scheme: a grid of two settings, each cell coloured by how its run ended. */
public final class StabilityPlot {

    private static final List<String> COLUMNS =
            List.of("scheme", "precision", "axis", "value", "second_axis", "second_value", "status");
    private static final List<String> STATUSES = List.of("ok", "diverged", "unstable");
    private static final Color[] COLOURS = {new Color(0x9ecae1), new Color(0xfdae6b), new Color(0xde2d26)};

    private StabilityPlot() {
    }

    /**
     * Draws {@code stability-SCHEME-PRECISION-AXIS-AXIS.png} into a folder for each map of a study.
     *
     * @param csv what {@code natator-sim bench stability} wrote
     * @return the PNG files
     * @throws IOException           if a picture cannot be written
     * @throws InvalidInputException if the CSV cannot be used
     */
    public static List<Path> draw(Path csv, Path folder) throws IOException {
        ResultTable table = ResultTable.read(csv, COLUMNS);
        List<Path> pictures = new ArrayList<>();
        for (String scheme : table.distinct("scheme")) {
            for (String precision : table.distinct("precision")) {
                ResultTable runs = table.where("scheme", scheme, "precision", precision);
                for (String first : runs.distinct("axis")) {
                    ResultTable ofAxis = runs.where("axis", first);
                    for (String second : ofAxis.distinct("second_axis")) {
                        if (!second.isEmpty()) {
                            String name = String.join("-", "stability", scheme, precision, first, second);
                            String title = "Scheme " + scheme + " in " + precision
                                    + ": blue ok, orange diverged, red unstable";
                            HeatMapChart chart = chart(title, first, second, ofAxis.where("second_axis", second));
                            pictures.add(Picture.save(chart, folder.resolve(name)));
                        }
                    }
                }
            }
        }
        return pictures;
    }

    private static HeatMapChart chart(String title, String first, String second, ResultTable runs) {
        List<String> x = ascending(runs, "value");
        List<String> y = ascending(runs, "second_value");
        List<Number[]> cells = new ArrayList<>();
        for (List<String> row : runs.rows()) {
            cells.add(new Number[] {x.indexOf(runs.text(row, "value")), y.indexOf(runs.text(row, "second_value")),
                status(runs.text(row, "status"))});
        }
        HeatMapChart chart = new HeatMapChartBuilder().width(760).height(480).title(title).xAxisTitle(first)
                .yAxisTitle(second).build();
        chart.getStyler().setMin(0).setMax(STATUSES.size() - 1.0).setRangeColors(COLOURS).setDrawBorder(true)
                .setPlotGridLinesVisible(false).setLegendVisible(false).setChartBackgroundColor(Color.WHITE);
        chart.addSeries("status", x, y, cells);
        return chart;
    }

    private static List<String> ascending(ResultTable runs, String column) {
        return runs.distinct(column).stream().sorted(Comparator.comparingDouble(Double::parseDouble)).toList();
    }

    private static int status(String name) {
        int index = STATUSES.indexOf(name);
        if (index < 0) {
            throw new InvalidInputException("status is \"" + name + "\": must be one of " + STATUSES);
        }
        return index;
    }
}
