package io.natator.study.thesis;

import io.natator.config.Scheme;
import io.natator.report.ReportDocument;
import io.natator.study.Sample;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/** Where the numbers differ from the published ones and from Flex 1.2.0, and what changes them most. */
final class DifferencesSection {

    /** Differences of so many standard errors count as agreement. */
    private static final double ERRORS = 3;
    /** Where nothing scatters, as in vacuum, a difference of rounding remains. Scene units per second. */
    private static final double ROUNDING = 0.005;

    private final StudyResults results;

    DifferencesSection(StudyResults results) {
        this.results = results;
    }

    void add(ReportDocument page) {
        page.heading(2, "Disagreements and their causes");
        page.heading(3, "With the thesis");
        page.text("Published speeds against those of the same gait, and of the best that evolved, in scheme `flex`; "
                + "1 would be the same.");
        page.table(List.of("creature", "medium", "published", "thesis' gait, Flex 1.2.0 / published",
                "thesis' gait, flex / published", "best evolved, flex / published"), published());
        page.heading(3, "With Flex 1.2.0");
        page.text(String.format(Locale.ROOT, "The same gaits in the same scene, which is what scheme `flex` is to agree "
                + "with. The difference is given in standard errors of both means together; up to %.0f, or "
                + "up to %s scene units/s, count as agreement.", ERRORS, ROUNDING));
        page.table(List.of("gait", "setting", "Flex 1.2.0", "flex", "difference", "agrees"), flex());
        page.heading(3, "What decides");
        page.text("Speed in fluid of the published gaits in scheme `flex` where one thing is changed.");
        page.table(List.of("gait", "as stated", "no friction", "no acceleration clamp", "no damping", "no viscosity",
                "inverse mass linear"), decisive());
    }

    private List<List<String>> published() {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : results.data().gaits()) {
            if (gait.published() == null) {
                continue;
            }
            EvolvedRun best = results.best(gait.creature(), Scheme.FLEX);
            for (String setting : List.of(ExperimentCatalogue.FLUID, ExperimentCatalogue.VACUUM)) {
                double published = setting.equals(ExperimentCatalogue.FLUID) ? gait.published().speed()
                        : gait.published().vacuumSpeed();
                double measured = gait.flex().stream().filter(one -> one.setting().equals(setting))
                        .mapToDouble(ThesisData.FlexSpeed::mean).findFirst().orElse(Double.NaN);
                rows.add(List.of("" + gait.creature(), setting, TableFormat.number(published),
                        TableFormat.shortNumber(measured / published),
                        TableFormat.shortNumber(results.speed(gait, Scheme.FLEX, setting).mean() / published),
                        best == null ? TableFormat.NOTHING
                                : TableFormat.shortNumber(results.speed(best, setting).mean() / published)));
            }
        }
        return rows;
    }

    private List<List<String>> flex() {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : results.data().gaits()) {
            for (ThesisData.FlexSpeed measured : gait.flex()) {
                Sample ours = results.speed(gait, Scheme.FLEX, measured.setting());
                if (ours.count() == 0) {
                    continue;
                }
                Sample theirs = SpeedTables.sample(measured);
                double difference = Math.abs(ours.mean() - theirs.mean());
                double errors = difference / Math.hypot(standardError(ours), standardError(theirs));
                boolean known = Double.isFinite(errors);
                rows.add(List.of(gait.creature() + ", " + gait.about(), measured.setting(), TableFormat.speed(theirs),
                        TableFormat.speed(ours), known ? String.format(Locale.ROOT, "%.1f", errors)
                        : TableFormat.NOTHING,
                        difference <= ROUNDING || known && errors <= ERRORS ? "yes" : "no"));
            }
        }
        return rows;
    }

    /** Of the mean; 0 where there is a single run, which says nothing of its spread. */
    private static double standardError(Sample sample) {
        return sample.hasSpread() ? sample.standardDeviation() / Math.sqrt(sample.count()) : 0;
    }

    private List<List<String>> decisive() {
        List<List<String>> rows = new ArrayList<>();
        for (String name : ExperimentCatalogue.STUDIED_GAITS) {
            ThesisData.PublishedGait gait = results.data().gait(name);
            rows.add(List.of(gait.creature() + ", " + gait.about(), changed(name, Parameter.FRICTION, 0.2),
                    changed(name, Parameter.FRICTION, 0), changed(name, Parameter.MAX_ACCELERATION, 1e30),
                    changed(name, Parameter.DAMPING, 0), changed(name, Parameter.VISCOSITY, 0),
                    TableFormat.speed(results.speed(gait, Scheme.FLEX, ExperimentCatalogue.INVERSE_MASS))));
        }
        return rows;
    }

    private String changed(String gait, Parameter parameter, double value) {
        return TableFormat.speed(results.measurements()
                .speed(ExperimentTables.of(results, parameter, value, gait, Scheme.FLEX, false)));
    }
}
