package io.natator.study.thesis;

import io.natator.checkpoint.StoredRun;
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
        page.heading(3, "Evolution");
        page.text("Best of each generation, as the evolution judged it, and the population's mean; the best is what chance has favoured most.");
        for (int creature = 1; creature <= 4; creature++) {
            XYChart chart = Charts.lines("Creature " + creature + ": way of the best, and of the mean", "generation", "scene units");
            for (EvolvedRun run : results.runs()) {
                if (run.creature() == creature) {
                    List<GenerationSummary> history = StoredRun.state(run.plan().directory()).history();
                    double[] generations = history.stream().mapToDouble(GenerationSummary::generation).toArray();
                    String name = run.water().words() + ", seed " + run.seed();
                    int number = 2 * ((int) run.seed() - 1) + run.water().ordinal();
                    Charts.add(chart, name, generations, history.stream().mapToDouble(GenerationSummary::best).toArray(), number, 2f);
                    Charts.add(chart, name + ", mean", generations, history.stream().mapToDouble(GenerationSummary::mean).toArray(), number, 0.8f);
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
        return name.startsWith("thesis-") ? "Gait " + name.substring(7) + " of the thesis, flex"
                : "Best evolved, " + name.replace("-flex", ", flex").replace("-open-water", ", open water");
    }

    private void addParameters(ReportDocument page) throws IOException {
        page.heading(3, "Parameters (4.1)");
        page.text("Speed along the own heading by that at the scene's own value, where a gait swims there. Values are equally spaced on the axis.");
        for (Parameter parameter : Parameter.values()) {
            for (Water water : Water.values()) {
                if (parameter.in(water).isPresent()) {
                    addParameter(page, parameter, parameter.in(water).get(), water);
                }
            }
        }
    }

    private void addParameter(ReportDocument page, Parameter parameter, Parameter.Range range, Water water) throws IOException {
        XYChart chart = Charts.lines("Speed over " + parameter.label() + ", " + water.words() + " (own value " + TableFormat.value(range.standard()) + ")",
                parameter.label(), "share of the speed at the own value");
        Charts.name(chart, range.values().stream().map(TableFormat::value).toList());
        int number = 0;
        for (Subject subject : results.studied(water)) {
            addCurve(chart, parameter, range, subject, number++);
        }
        if (!chart.getSeriesMap().isEmpty()) {
            String file = "4.1-" + (parameter.label() + " " + water.label()).replace(' ', '-');
            page.picture(Picture.save(chart, folder.resolve(file)), "speed over " + parameter.label() + ", " + water.words());
        }
    }

    private void addCurve(XYChart chart, Parameter parameter, Parameter.Range range, Subject subject, int number) {
        Sample usual = forward(parameter, range.standard(), subject);
        if (!new Trend(usual, List.of()).swims()) {
            return;
        }
        List<double[]> points = new ArrayList<>();
        for (int i = 0; i < range.values().size(); i++) {
            Sample speed = forward(parameter, range.values().get(i), subject);
            if (speed.count() > 0) {
                points.add(new double[] {i + 1, speed.mean() / usual.mean(), speed.hasSpread() ? speed.standardDeviation() / usual.mean() : 0});
            }
        }
        Charts.addWithSpread(chart, ParameterClaims.name(subject), points.stream().mapToDouble(point -> point[0]).toArray(),
                points.stream().mapToDouble(point -> point[1]).toArray(), points.stream().mapToDouble(point -> point[2]).toArray(), number);
    }

    private Sample forward(Parameter parameter, double value, Subject subject) {
        return results.measurements().forward(results.catalogue().study(subject, parameter, value, false));
    }
}
