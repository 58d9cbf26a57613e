package io.natator.report;

import io.natator.config.WeightedObjective;
import io.natator.evolution.Individual;
import io.natator.plot.Picture;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYSeries.XYSeriesRenderStyle;

/** Draws the gaits of several objectives: all of the last generation, and those that no other is better than in all. */
final class FrontPlot {

    private FrontPlot() {
    }

    /**
     * Draws two of the objectives.
     *
     * @param first  which, from 0, to the right
     * @param second which, upwards
     * @param file   without its extension
     */
    static Path draw(String title, List<WeightedObjective> objectives, List<Individual> population, List<Individual> front,
            int first, int second, Path file) throws IOException {
        XYChart chart = Charts.lines(title, name(objectives, first), name(objectives, second));
        chart.getStyler().setDefaultSeriesRenderStyle(XYSeriesRenderStyle.Scatter);
        add(chart, "all", population, first, second);
        add(chart, "not dominated", front, first, second);
        return Picture.save(chart, file);
    }

    private static void add(XYChart chart, String name, List<Individual> individuals, int first, int second) {
        List<Individual> measured = individuals.stream().filter(one -> one.objectives() != null).toList();
        if (!measured.isEmpty()) {
            chart.addSeries(name, measured.stream().mapToDouble(one -> one.objectives().get(first)).toArray(),
                    measured.stream().mapToDouble(one -> one.objectives().get(second)).toArray());
        }
    }

    private static String name(List<WeightedObjective> objectives, int which) {
        return objectives.get(which).objective().name().toLowerCase(Locale.ROOT) + " (more is better)";
    }
}
