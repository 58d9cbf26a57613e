package io.natator.study.thesis;

import io.natator.report.ReportDocument;
import io.natator.study.Sample;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;

/** The published gaits in scheme flex beside the published numbers and beside NVIDIA Flex 1.2.0, and what decides them. */
final class FlexSection {

    /** Differences of so many standard errors count as agreement. */
    private static final double ERRORS = 3;
    /** Where nothing scatters, as in vacuum, a difference of rounding remains. Scene units per second. */
    private static final double ROUNDING = 0.005;
    private static final int FLEX_RUNS = 5;
    private static final Map<String, Condition> SETTINGS = Map.of("fluid", Condition.WATER, "fluid-inverse-mass", Condition.INVERSE_MASS,
            "vacuum", Condition.VACUUM);

    private final StudyResults results;

    FlexSection(StudyResults results) {
        this.results = results;
    }

    void add(ReportDocument page) {
        page.heading(2, "Beside the thesis and Flex 1.2.0");
        page.text(String.format(Locale.ROOT, "The published gaits in the thesis' scene, units/s over 0 to 4 s, mean ± standard deviation; Flex 1.2.0 ran five times where it has a "
                + "deviation, else once. ± of a single run is not known, so its difference is given in units/s. Differences are in standard errors of "
                + "both means; they agree by up to %.0f of them, or by less than %s units/s, which is more than some of these speeds. The thesis used Flex 1.1.0. All "
                + "45 scenes that were recorded with Flex, and the unperturbed runs beside ensembles: [beside Flex](../flex-comparison/README.md).", ERRORS, ROUNDING));
        page.table(List.of("gait", "setting", "thesis", "Flex 1.2.0", "flex", "difference", "agrees by"), rows());
        page.folded("what decides the published gaits' speed in `flex`", inside -> inside.table(List.of("gait", "as stated", "no friction",
                "no acceleration clamp", "no damping", "no viscosity", "inverse mass linear"), decisive()));
    }

    private List<List<String>> rows() {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : results.data().gaits()) {
            for (String setting : List.of("fluid", "fluid-inverse-mass", "vacuum")) {
                Sample ours = results.speed(Subject.of(gait, Water.FLEX), SETTINGS.get(setting));
                Sample theirs = gait.flex().stream().filter(one -> one.setting().equals(setting)).findFirst().map(FlexSection::sample)
                        .orElse(new Sample(0, Double.NaN, Double.NaN));
                double published = gait.published() == null || setting.equals("fluid-inverse-mass") ? Double.NaN
                        : setting.equals("vacuum") ? gait.published().vacuumSpeed() : gait.published().speed();
                if (ours.count() > 0 && (theirs.count() > 0 || !Double.isNaN(published))) {
                    rows.add(row(gait, setting, published, theirs, ours));
                }
            }
        }
        return rows;
    }

    private static List<String> row(ThesisData.PublishedGait gait, String setting, double published, Sample theirs, Sample ours) {
        double difference = ours.mean() - theirs.mean();
        double errors = Math.abs(difference) / Math.hypot(ours.standardError(), theirs.standardError());
        boolean isSingle = !theirs.hasSpread();
        String told = theirs.count() == 0 ? TableFormat.NOTHING : isSingle ? String.format(Locale.ROOT, "%+.4f", difference)
                : String.format(Locale.ROOT, "%.1f", errors);
        String agrees = theirs.count() == 0 ? TableFormat.NOTHING : !isSingle && errors <= ERRORS ? "✔ standard errors"
                : Math.abs(difference) <= ROUNDING ? "✔ less than " + ROUNDING : "✘ no";
        return List.of(gait.creature() + ", " + gait.about(), setting, TableFormat.number(published), TableFormat.speed(theirs), TableFormat.speed(ours),
                told, agrees);
    }

    /** Measurements with Flex: one run, or five that give a spread. */
    private static Sample sample(ThesisData.FlexSpeed measured) {
        return measured.deviation() == null ? new Sample(1, measured.mean(), Double.NaN)
                : new Sample(FLEX_RUNS, measured.mean(), measured.deviation());
    }

    private List<List<String>> decisive() {
        List<List<String>> rows = new ArrayList<>();
        for (Subject subject : results.catalogue().published(Water.FLEX)) {
            rows.add(List.of(subject.creature() + ", " + subject.about(), TableFormat.speed(results.speed(subject, Condition.WATER)),
                    changed(subject, Parameter.FRICTION, 0), TableFormat.speed(results.speed(subject, Condition.NO_CLAMP)),
                    changed(subject, Parameter.DAMPING, 0), changed(subject, Parameter.VISCOSITY, 0),
                    TableFormat.speed(results.speed(subject, Condition.INVERSE_MASS))));
        }
        return rows;
    }

    private String changed(Subject subject, Parameter parameter, double value) {
        return TableFormat.speed(results.measurements().speed(results.catalogue().study(subject, parameter, value, false), results.duration()));
    }
}
