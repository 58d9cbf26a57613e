package io.natator.study.thesis;

import io.natator.checkpoint.BestGait;
import io.natator.config.Scheme;
import io.natator.report.Page;
import io.natator.study.Sample;
import java.util.ArrayList;
import java.util.List;

/** Table 3.1, speeds in fluid and vacuum, and speeds in body lengths. */
final class SpeedTables {

    private static final int FLEX_RUNS = 5;

    private final Findings findings;

    SpeedTables(Findings findings) {
        this.findings = findings;
    }

    void add(Page page) {
        page.heading(3, "Table 3.1: the gaits");
        page.text("Published, and the best of each evolution; v is the mean speed of the evaluation that won, in scene "
                + "units per second.");
        page.table(List.of("creature", "from", "f (1/s)", "a", "φ", "v"), gaits());
        page.heading(3, "Speed in fluid (scene units/s)");
        page.text("Mean ± standard deviation over perturbed runs; for evolved gaits over the seeds of evolution, of the "
                + "mean over perturbed runs of each.");
        page.table(columns(), speeds(Catalogue.FLUID));
        page.heading(3, "Speed in fluid whose inverse mass is linear in height");
        page.text("The thesis' \"mass linear from 2 to 1/14\" read as inverse mass linear from 1/2 to 14: bodies then stay "
                + "inside the water.");
        page.table(columns(), speeds(Catalogue.INVERSE_MASS));
        page.heading(3, "Speed in vacuum: no fluid, gravity or planes");
        page.text("A gait that advances here is not swimming.");
        page.table(columns(), speeds(Catalogue.VACUUM));
        page.heading(3, "Speed in body lengths per second");
        page.text("An eel swims at " + findings.data().eelBodyLengths() + " (thesis). The thesis counts 2.4 scene units for "
                + "creature 1, whose particles at 0.075 make 1.2; its value is given as published.");
        page.table(List.of("creature", "body length", "published", "thesis' gait, flex", "thesis' gait, conserving",
                "evolved, flex", "evolved, conserving"), bodyLengths());
        page.heading(3, "Each evolution");
        page.table(List.of("run folder", "distance", "fluid", "vacuum", "inverse-mass fluid", "in the other scheme"),
                evolutions());
    }

    private List<List<String>> gaits() {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : findings.data().gaits()) {
            if (gait.published() != null) {
                rows.add(List.of("" + gait.creature(), "thesis", Shown.number(gait.gait().frequency()),
                        Shown.list(gait.gait().amplitude()), Shown.list(gait.gait().phase()),
                        Shown.number(gait.published().speed())));
            }
        }
        for (EvolvedRun run : findings.evolved()) {
            BestGait best = findings.catalogue().best(run);
            rows.add(List.of("" + run.creature(), Shown.name(run.scheme()) + ", seed " + run.seed(),
                    Shown.number(best.gait().frequency()), Shown.list(best.gait().amplitude()),
                    Shown.list(best.gait().phase()), Shown.number(best.speed())));
        }
        return rows;
    }

    private static List<String> columns() {
        return List.of("creature", "published", "thesis' gait, Flex 1.2.0", "thesis' gait, flex",
                "thesis' gait, conserving", "evolved, flex", "evolved, conserving");
    }

    private List<List<String>> speeds(String setting) {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : findings.data().gaits()) {
            boolean first = gait.published() != null;
            double published = !first || setting.equals(Catalogue.INVERSE_MASS) ? Double.NaN
                    : setting.equals(Catalogue.VACUUM) ? gait.published().vacuumSpeed() : gait.published().speed();
            rows.add(List.of(gait.creature() + (first ? "" : ", " + gait.about()), Shown.number(published),
                    flex(gait, setting), Shown.speed(findings.speed(gait, Scheme.FLEX, setting)),
                    Shown.speed(findings.speed(gait, Scheme.CONSERVING, setting)),
                    first ? Shown.speed(findings.speedOverSeeds(gait.creature(), Scheme.FLEX, setting)) : Shown.NOTHING,
                    first ? Shown.speed(findings.speedOverSeeds(gait.creature(), Scheme.CONSERVING, setting))
                            : Shown.NOTHING));
        }
        return rows;
    }

    private static String flex(ThesisData.PublishedGait gait, String setting) {
        return gait.flex().stream().filter(one -> one.setting().equals(setting)).findFirst()
                .map(one -> Shown.speed(sample(one))).orElse(Shown.NOTHING);
    }

    /** Measurements with Flex: one run, or five that give a spread. */
    static Sample sample(ThesisData.FlexSpeed measured) {
        return measured.deviation() == null ? new Sample(1, measured.mean(), Double.NaN)
                : new Sample(FLEX_RUNS, measured.mean(), measured.deviation());
    }

    private List<List<String>> bodyLengths() {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : findings.data().gaits()) {
            double length = findings.bodyLength(gait.creature());
            boolean first = gait.published() != null;
            rows.add(List.of(gait.creature() + (first ? "" : ", " + gait.about()), Shown.shortNumber(length),
                    first ? Shown.number(gait.published().speed() / length) : Shown.NOTHING,
                    Shown.number(findings.speed(gait, Scheme.FLEX, Catalogue.FLUID).mean() / length),
                    Shown.number(findings.speed(gait, Scheme.CONSERVING, Catalogue.FLUID).mean() / length),
                    first ? over(gait.creature(), Scheme.FLEX, length) : Shown.NOTHING,
                    first ? over(gait.creature(), Scheme.CONSERVING, length) : Shown.NOTHING));
        }
        return rows;
    }

    private String over(int creature, Scheme scheme, double length) {
        return Shown.number(findings.speedOverSeeds(creature, scheme, Catalogue.FLUID).mean() / length);
    }

    private List<List<String>> evolutions() {
        return findings.evolved().stream().map(run -> List.of("`" + findings.catalogue().subject(run) + "`",
                Shown.number(findings.catalogue().best(run).distance()), Shown.speed(findings.speed(run, Catalogue.FLUID)),
                Shown.speed(findings.speed(run, Catalogue.VACUUM)),
                Shown.speed(findings.speed(run, Catalogue.INVERSE_MASS)),
                Shown.speed(findings.measurements().speed(findings.catalogue().crossed(run))))).toList();
    }
}
