package io.natator.study.thesis;

import io.natator.checkpoint.BestGait;
import io.natator.config.Scheme;
import io.natator.report.ReportDocument;
import io.natator.study.Sample;
import java.util.ArrayList;
import java.util.List;

/** Table 3.1, speeds in fluid and vacuum, and speeds in body lengths. */
final class SpeedTables {

    private static final int FLEX_RUNS = 5;

    private final StudyResults results;

    SpeedTables(StudyResults results) {
        this.results = results;
    }

    void add(ReportDocument page) {
        page.heading(3, "Table 3.1: the gaits");
        page.text("Published, and the best of each evolution; v is the mean speed of the evaluation that won, in scene "
                + "units per second.");
        page.table(List.of("creature", "from", "f (1/s)", "a", "φ", "v"), gaits());
        page.heading(3, "Speed in fluid (scene units/s)");
        page.text("Mean ± standard deviation over perturbed runs; for evolved gaits over the seeds of evolution, of the "
                + "mean over perturbed runs of each.");
        page.table(columns(), speeds(ExperimentCatalogue.FLUID));
        page.heading(3, "Speed in fluid whose inverse mass is linear in height");
        page.text("The thesis' \"mass linear from 2 to 1/14\" read as inverse mass linear from 1/2 to 14: bodies then stay "
                + "inside the water.");
        page.table(columns(), speeds(ExperimentCatalogue.INVERSE_MASS));
        page.heading(3, "Speed in vacuum: no fluid, gravity or planes");
        page.text("A gait that advances here is not swimming.");
        page.table(columns(), speeds(ExperimentCatalogue.VACUUM));
        page.heading(3, "Speed in body lengths per second");
        page.text("An eel swims at " + results.data().eelBodyLengths()
                + " (thesis). The thesis counts 2.4 scene units for "
                + "creature 1, whose particles at 0.075 make 1.2; its value is given as published.");
        page.table(List.of("creature", "body length", "published", "thesis' gait, flex", "thesis' gait, conserving",
                "evolved, flex", "evolved, conserving"), bodyLengths());
        page.heading(3, "Each evolution");
        page.table(List.of("run folder", "distance", "fluid", "vacuum", "inverse-mass fluid", "in the other scheme"),
                evolutions());
    }

    private List<List<String>> gaits() {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : results.data().gaits()) {
            if (gait.published() != null) {
                rows.add(List.of("" + gait.creature(), "thesis", TableFormat.number(gait.gait().frequency()),
                        TableFormat.list(gait.gait().amplitude()), TableFormat.list(gait.gait().phase()),
                        TableFormat.number(gait.published().speed())));
            }
        }
        for (EvolvedRun run : results.evolved()) {
            BestGait best = results.catalogue().best(run);
            rows.add(List.of("" + run.creature(), TableFormat.name(run.scheme()) + ", seed " + run.seed(),
                    TableFormat.number(best.gait().frequency()), TableFormat.list(best.gait().amplitude()),
                    TableFormat.list(best.gait().phase()), TableFormat.number(best.speed())));
        }
        return rows;
    }

    private static List<String> columns() {
        return List.of("creature", "published", "thesis' gait, Flex 1.2.0", "thesis' gait, flex",
                "thesis' gait, conserving", "evolved, flex", "evolved, conserving");
    }

    private List<List<String>> speeds(String setting) {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : results.data().gaits()) {
            boolean first = gait.published() != null;
            double published = !first || setting.equals(ExperimentCatalogue.INVERSE_MASS) ? Double.NaN
                    : setting.equals(ExperimentCatalogue.VACUUM) ? gait.published().vacuumSpeed()
                    : gait.published().speed();
            rows.add(List.of(gait.creature() + (first ? "" : ", " + gait.about()), TableFormat.number(published),
                    flex(gait, setting), TableFormat.speed(results.speed(gait, Scheme.FLEX, setting)),
                    TableFormat.speed(results.speed(gait, Scheme.CONSERVING, setting)),
                    first ? TableFormat.speed(results.speedOverSeeds(gait.creature(), Scheme.FLEX, setting))
                    : TableFormat.NOTHING,
                    first ? TableFormat.speed(results.speedOverSeeds(gait.creature(), Scheme.CONSERVING, setting))
                            : TableFormat.NOTHING));
        }
        return rows;
    }

    private static String flex(ThesisData.PublishedGait gait, String setting) {
        return gait.flex().stream().filter(one -> one.setting().equals(setting)).findFirst()
                .map(one -> TableFormat.speed(sample(one))).orElse(TableFormat.NOTHING);
    }

    /** Measurements with Flex: one run, or five that give a spread. */
    static Sample sample(ThesisData.FlexSpeed measured) {
        return measured.deviation() == null ? new Sample(1, measured.mean(), Double.NaN)
                : new Sample(FLEX_RUNS, measured.mean(), measured.deviation());
    }

    private List<List<String>> bodyLengths() {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : results.data().gaits()) {
            double length = results.bodyLength(gait.creature());
            boolean first = gait.published() != null;
            rows.add(List.of(gait.creature() + (first ? "" : ", " + gait.about()), TableFormat.shortNumber(length),
                    first ? TableFormat.number(gait.published().speed() / length) : TableFormat.NOTHING,
                    TableFormat.number(results.speed(gait, Scheme.FLEX, ExperimentCatalogue.FLUID).mean() / length),
                    TableFormat.number(
                            results.speed(gait, Scheme.CONSERVING, ExperimentCatalogue.FLUID).mean() / length),
                    first ? over(gait.creature(), Scheme.FLEX, length) : TableFormat.NOTHING,
                    first ? over(gait.creature(), Scheme.CONSERVING, length) : TableFormat.NOTHING));
        }
        return rows;
    }

    private String over(int creature, Scheme scheme, double length) {
        return TableFormat.number(results.speedOverSeeds(creature, scheme, ExperimentCatalogue.FLUID).mean() / length);
    }

    private List<List<String>> evolutions() {
        return results.evolved().stream().map(run -> List.of("`" + results.catalogue().subject(run) + "`",
                TableFormat.number(results.catalogue().best(run).distance()),
                TableFormat.speed(results.speed(run, ExperimentCatalogue.FLUID)),
                TableFormat.speed(results.speed(run, ExperimentCatalogue.VACUUM)),
                TableFormat.speed(results.speed(run, ExperimentCatalogue.INVERSE_MASS)),
                TableFormat.speed(results.measurements().speed(results.catalogue().crossed(run))))).toList();
    }
}
