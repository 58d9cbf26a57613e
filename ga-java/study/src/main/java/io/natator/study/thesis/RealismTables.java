package io.natator.study.thesis;

import io.natator.config.Numbers;
import io.natator.kinematics.FishMode;
import io.natator.kinematics.ModeFit;
import io.natator.report.ReportDocument;
import io.natator.study.Sample;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.function.Function;

/** Table 3.2: which fish a creature swims like; and how the bodies lie and turn. */
final class RealismTables {

    private final StudyResults results;

    RealismTables(StudyResults results) {
        this.results = results;
    }

    void add(ReportDocument page) {
        page.heading(3, "Table 3.2: e against real fish");
        page.text("0 is the same motion; *none* is the e of a spine that does not move, √(x_l/L)/3, x_l being where the shortest spine ends. So the "
                + "least e alone names no fish: *like* is the nearest of those that have at most 0.8 of none and that the "
                + "simulated spine need not be scaled to less than a tenth for (α below 0.1). An eel by the formula itself has an e of up to 0.04, "
                + "since its spine does not lie about its line of best fit. α scales the simulated spine: as printed in the thesis it scales the real one, which "
                + "cannot give its values. Sideways is z, as in the thesis; mean ± standard deviation over recorded runs. Flex 1.2.0: the same measure on one "
                + "recorded run.");
        page.table(List.of("creature", "from", "anguilliform", "carangiform", "thunniform", "none", "x_l/L", "like"),
                errors(SwimKinematics::fits, true));
        page.heading(3, "The same with the body's roll taken out");
        page.text("A body that tips over bends in a plane that the thesis' measure does not look at. Here sideways is the "
                + "body's own side.");
        page.table(List.of("creature", "from", "anguilliform", "carangiform", "thunniform", "none", "x_l/L", "like"),
                errors(SwimKinematics::fitsOfBody, false));
        page.heading(3, "How the bodies lie");
        page.text("At the end of the recorded runs; the swing is the largest amplitude at the end of the measured spine. "
                + "A real eel's is 0.1 body lengths.");
        page.table(List.of("creature", "from", "roll θ (degrees)", "largest yaw ρ (degrees)", "height y at start → end",
                "swing (body lengths)"), attitudes());
    }

    /** A row's name and its recorded runs. */
    private record Recorded(String creature, String from, List<SwimKinematics> motions) {
    }

    private List<Recorded> recorded() {
        List<Recorded> recorded = new ArrayList<>();
        results.subjects().forEach(subject -> {
            recorded.add(new Recorded("" + subject.creature(), subject.label() + ", " + subject.water().words(), results.motions(subject)));
            if (!subject.isEvolved() && subject.water() == Water.FLEX) {
                recorded.add(new Recorded("" + subject.creature(), subject.label() + ", flex, inverse mass linear", results.motionsOfInverseMass(subject)));
            }
        });
        return recorded.stream().filter(one -> !one.motions().isEmpty()).toList();
    }

    private List<List<String>> errors(Function<SwimKinematics, List<ModeFit>> fits, boolean withPublished) {
        List<List<String>> rows = new ArrayList<>();
        if (withPublished) {
            for (ThesisData.PublishedGait gait : results.data().gaits()) {
                if (gait.published() != null) {
                    rows.add(row("" + gait.creature(), "published", gait.published().errors()));
                }
                gait.flex().stream().filter(one -> one.errors() != null).forEach(one -> rows.add(row(gait.creature()
                        + (gait.published() != null ? "" : ", " + gait.about()), "thesis' gait, Flex 1.2.0"
                        + (one.setting().equals("fluid-inverse-mass") ? ", inverse mass linear" : ""),
                        one.errors())));
            }
        }
        for (Recorded one : recorded()) {
            List<String> row = new ArrayList<>(List.of(one.creature(), one.from()));
            Arrays.stream(FishMode.values()).forEach(mode -> row.add(TableFormat.speed(StudyResults.error(one.motions(), mode, fits)) + ", α "
                    + TableFormat.shortNumber(StudyResults.scale(one.motions(), mode, fits))));
            double part = one.motions().stream().mapToDouble(SwimKinematics::measuredPart).average().orElseThrow();
            row.add(TableFormat.shortNumber(Math.sqrt(part) / 3));
            row.add(TableFormat.shortNumber(part));
            row.add(StudyResults.like(one.motions(), fits).map(FishMode::label).orElse("none"));
            rows.add(row);
        }
        return rows;
    }

    private static List<String> row(String creature, String from, List<Double> errors) {
        List<String> row = new ArrayList<>(List.of(creature, from));
        errors.forEach(error -> row.add(TableFormat.number(error)));
        row.addAll(List.of(TableFormat.NOTHING, TableFormat.NOTHING, TableFormat.NOTHING));
        return row;
    }

    private List<List<String>> attitudes() {
        return recorded().stream().map(subject -> {
            List<SwimKinematics> motions = subject.motions();
            return List.of(subject.creature(), subject.from(),
                    degrees(motions.stream().map(motion -> Math.toDegrees(motion.end().roll())).toList()),
                    degrees(motions.stream().map(motion -> Math.toDegrees(motion.largestYaw())).toList()),
                    TableFormat.shortNumber(mean(motions, 0)) + " → " + TableFormat.shortNumber(mean(motions, 1)),
                    TableFormat.shortNumber(
                            motions.stream().mapToDouble(SwimKinematics::tailSwing).average().orElse(Double.NaN)));
        }).toList();
    }

    private static double mean(List<SwimKinematics> motions, int which) {
        return motions.stream().mapToDouble(motion -> motion.heights().get(which)).average().orElse(Double.NaN);
    }

    private static String degrees(List<Double> values) {
        Sample sample = Sample.of(values);
        return sample.hasSpread() ? Numbers.withError(sample.mean(), sample.standardDeviation(), 0)
                : Numbers.fixed(sample.mean(), 0);
    }
}
