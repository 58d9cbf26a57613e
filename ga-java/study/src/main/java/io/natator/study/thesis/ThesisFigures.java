package io.natator.study.thesis;

import io.natator.checkpoint.StoredRun;
import io.natator.config.Scheme;
import io.natator.evolution.GenerationSummary;
import io.natator.flow.FlowField;
import io.natator.kinematics.FishMode;
import io.natator.plot.Picture;
import io.natator.report.Charts;
import io.natator.report.FlowPlot;
import io.natator.report.MotionPlots;
import io.natator.report.Recording;
import io.natator.report.ReportDocument;
import io.natator.study.Sample;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import org.knowm.xchart.XYChart;

/** The pictures of the report. */
final class ThesisFigures {

    private final Path folder;
    private final StudyResults results;
    private final Map<String, Recording> recordings;

    /** Pictures go into {@code figures} in the folder. */
    ThesisFigures(Path folder, StudyResults results, Map<String, Recording> recordings) {
        this.folder = folder.resolve("figures");
        this.results = results;
        this.recordings = recordings;
    }

    void add(ReportDocument page) throws IOException {
        page.text("Curves of spines and envelopes end where the shortest spine does: bent, it is shorter along its line than the "
                + "body is at rest, and beyond that its motion is not known at all times (thesis 2.8).");
        addFitness(page);
        addMotions(page);
        addParameters(page);
    }

    private void addFitness(ReportDocument page) throws IOException {
        page.heading(3, "Fitness over generations");
        for (int creature = 1; creature <= 4; creature++) {
            XYChart chart = Charts.lines("Creature " + creature + ": best distance", "generation", "scene units");
            for (Scheme scheme : ExperimentCatalogue.SCHEMES) {
                for (EvolvedRun run : results.evolved(creature, scheme)) {
                    List<GenerationSummary> history = StoredRun.state(run.plan().directory()).history();
                    Charts.add(chart, TableFormat.name(scheme) + ", seed " + run.seed(),
                            history.stream().mapToDouble(GenerationSummary::generation).toArray(),
                            history.stream().mapToDouble(GenerationSummary::best).toArray(), scheme.ordinal(),
                            (int) run.seed() - 1, 1.5f);
                }
            }
            if (!chart.getSeriesMap().isEmpty()) {
                page.picture(Picture.save(chart, folder.resolve("fitness-creature-" + creature)), "creature " + creature);
            }
        }
    }

    private void addMotions(ReportDocument page) throws IOException {
        for (Map.Entry<String, Recording> entry : recordings.entrySet()) {
            String name = entry.getKey();
            page.heading(3, title(name));
            MotionPlots plots = new MotionPlots(title(name), entry.getValue(), folder);
            page.picture(plots.position("3.1-position-" + name), "figure 3.1: position");
            page.picture(plots.rotation("3.1-rotation-" + name), "figure 3.1: rotation");
            page.picture(plots.spines("3.2-spines-" + name), "figure 3.2: spine in four phases");
            page.picture(plots.envelopes("3.3-envelopes-" + name), "figure 3.3: envelope against real fish");
            page.text(String.format(Locale.ROOT, "The simulated curves end at %.2f of the length.", plots.measuredPart()));
            if (entry.getValue().request().scene().endsWith("creature-2")) {
                page.picture(plots.scaled("3.4-scaled-" + name, FishMode.ANGUILLIFORM),
                        "figure 3.4: scaled against anguilliform fish");
                for (FlowField field : entry.getValue().flow()) {
                    String file = (field.view().ordinal() == 0 ? "3.5" : "3.6") + "-flow-" + name;
                    page.picture(FlowPlot.draw(title(name), field, folder.resolve(file)),
                            "figure " + file.substring(0, 3) + ": velocity and vorticity " + field.view().label());
                }
            }
        }
    }

    private static String title(String name) {
        return name.startsWith("thesis-") ? "Published gait " + name.substring(7) + ", flex"
                : "Best evolved, " + name.replace("-conserving", ", conserving").replace("-flex", ", flex");
    }

    private void addParameters(ReportDocument page) throws IOException {
        page.heading(3, "Parameters (4.1)");
        for (Parameter parameter : Parameter.values()) {
            XYChart chart = Charts.lines("Speed over " + parameter.label(), parameter.label() + label(parameter),
                    "speed in fluid (scene units/s)");
            int colour = 0;
            for (String gait : ExperimentCatalogue.STUDIED_GAITS) {
                for (Scheme scheme : ExperimentCatalogue.SCHEMES) {
                    addCurve(chart, parameter, gait, scheme, colour++);
                }
            }
            ExperimentCatalogue.SCHEMES.forEach(scheme -> addCost(chart, parameter, scheme));
            if (!chart.getSeriesMap().isEmpty()) {
                String file = "4.1-" + parameter.label().replace(' ', '-');
                page.picture(Picture.save(chart, folder.resolve(file)), "speed over " + parameter.label());
            }
        }
    }

    /** Values from 1 up over a wide range are drawn over their logarithm to base 2; no limit is left out. */
    private static boolean logarithmic(Parameter parameter) {
        return parameter == Parameter.SUBSTEPS || parameter == Parameter.ITERATIONS || parameter == Parameter.BODY_MASS
                || parameter == Parameter.MAX_ACCELERATION;
    }

    private static String label(Parameter parameter) {
        return logarithmic(parameter) ? " (logarithm to base 2)" : "";
    }

    private void addCurve(XYChart chart, Parameter parameter, String gait, Scheme scheme, int colour) {
        List<double[]> points = new ArrayList<>();
        for (double value : parameter.settings()) {
            Sample speed = results.measurements()
                    .speed(ExperimentTables.of(results, parameter, value, gait, scheme, false));
            if (speed.count() > 0 && value < 1e20) {
                points.add(new double[] {logarithmic(parameter) ? Math.log(value) / Math.log(2) : value, speed.mean(),
                    speed.hasSpread() ? speed.standardDeviation() : 0});
            }
        }
        if (!points.isEmpty()) {
            String name = String.format(Locale.ROOT, "creature %s, %s", gait.charAt(0), TableFormat.name(scheme));
            double[] x = points.stream().mapToDouble(point -> point[0]).toArray();
            double[] y = points.stream().mapToDouble(point -> point[1]).toArray();
            double[] deviation = points.stream().mapToDouble(point -> point[2]).toArray();
            Charts.addWithSpread(chart, name, x, y, deviation, colour);
        }
    }

    private void addCost(XYChart chart, Parameter parameter, Scheme scheme) {
        List<double[]> points = new ArrayList<>();
        for (double value : parameter.settings()) {
            double cost = results.timings().of(ExperimentTables.of(results, parameter, value,
                    ExperimentCatalogue.STUDIED_GAITS.get(0), scheme, false));
            if (Double.isFinite(cost) && value < 1e20) {
                points.add(new double[] {logarithmic(parameter) ? Math.log(value) / Math.log(2) : value, cost});
            }
        }
        if (!points.isEmpty()) {
            Charts.addOnTheRight(chart, "cost, " + TableFormat.name(scheme),
                    points.stream().mapToDouble(point -> point[0]).toArray(),
                    points.stream().mapToDouble(point -> point[1]).toArray(), "cost (core seconds per simulated second)",
                    scheme == Scheme.FLEX ? Color.GRAY : Color.LIGHT_GRAY, 1 + scheme.ordinal());
        }
    }
}
