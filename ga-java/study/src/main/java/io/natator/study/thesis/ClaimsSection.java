package io.natator.study.thesis;

import io.natator.config.Scheme;
import io.natator.kinematics.FishMode;
import io.natator.report.FirstScreen;
import io.natator.report.ReportDocument;
import io.natator.study.Sample;
import io.natator.verdict.Measure;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Locale;

/** What the numbers say, by rules that are stated beside them. */
final class ClaimsSection {

    private static final double NOISE = 3;
    private static final double DRIFT = 2;
    private static final double CONFINEMENT = 5;
    /** Slower is no motion in vacuum worth the name. Scene units per second. */
    private static final double STILL = 0.01;
    static final String YES = "yes";
    private static final String NO = "no";
    private static final String ABSENT = "no such motion";

    private final StudyResults results;

    ClaimsSection(StudyResults results) {
        this.results = results;
    }

    /**
     * Whether a gait swims: its speed is well above the noise of its runs and what it drifts in vacuum either way.
     *
     * @return yes, no, or nothing where it is not measured
     */
    static String swims(Sample fluid, Sample vacuum) {
        if (fluid.count() < 2 || vacuum.count() == 0) {
            return TableFormat.NOTHING;
        }
        boolean aboveNoise = fluid.mean() > NOISE * fluid.standardDeviation();
        boolean aboveDrift = fluid.mean() > DRIFT * Math.abs(vacuum.mean());
        return aboveNoise && aboveDrift ? YES : fluid.mean() <= 0 ? NO : !aboveNoise ? "no: within the noise"
                : vacuum.mean() > 0 ? "doubtful: drifts in vacuum too" : "doubtful: drifts backwards in vacuum";
    }

    /** What stands before an outcome: ✔, ✘ or –. */
    static String sign(String outcome) {
        return FirstScreen.SIGNS.get(outcome.equals(YES) ? Measure.Outcome.HOLDS
                : outcome.startsWith(NO) && !outcome.equals(ABSENT) ? Measure.Outcome.FAILS : Measure.Outcome.NOT_MEASURED);
    }

    /** How many of the conclusions that could be tested in a scheme hold, in words; null if none could. */
    String kept(Scheme scheme) {
        List<String> outcomes = claims(scheme).stream().map(row -> row.get(2)).filter(holds -> !holds.equals(ABSENT)).toList();
        return outcomes.isEmpty() ? null : outcomes.stream().filter(YES::equals).count() + " of " + outcomes.size();
    }

    void add(ReportDocument page) {
        page.heading(2, "All verdicts");
        page.text(String.format(Locale.ROOT, "Computed from the tables below. A gait swims if its speed in fluid is above "
                + "%.0f standard deviations of its runs and above %.0f times its speed in vacuum in either direction. Like "
                + "which fish: least e, with the body's roll taken out, of those that it is like at all: with an e of at most four fifths of "
                + "that of no motion, and without being made more than ten times smaller to fit. Best evolved: of the seeds, the fastest that swims, "
                + "else the fastest; evolution judges a gait by one run, and some of its winners tumble: all seeds are "
                + "under \"Each evolution\".", NOISE, DRIFT));
        page.folded("every gait", inside -> inside.table(List.of("creature", "gait", "swims", "fluid", "vacuum", "body lengths/s",
                "of an eel's speed", "like which fish (e)"), verdicts()));
        page.heading(2, "What of the thesis' conclusions holds");
        page.text("Each in both schemes, by creature 2's gait with twice the published phase step where nothing else is said. An answer by a "
                + "rule is no more than that: the numbers stand beside it.");
        page.folded("every conclusion", inside -> inside.words(List.of("the thesis says", "what was measured", "holds"),
                ExperimentCatalogue.SCHEMES.stream().flatMap(scheme -> claims(scheme).stream())
                        .map(row -> List.of(row.get(0), row.get(1), sign(row.get(2)) + " " + row.get(2))).toList()));
    }

    private List<List<String>> verdicts() {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : results.data().gaits()) {
            for (Scheme scheme : ExperimentCatalogue.SCHEMES) {
                rows.add(verdict(gait.creature(), "thesis" + (gait.published() != null ? "" : ", " + gait.about()) + ", "
                        + TableFormat.name(scheme), results.speed(gait, scheme, ExperimentCatalogue.FLUID),
                        results.speed(gait, scheme, ExperimentCatalogue.VACUUM), results.motions(gait, scheme)));
            }
        }
        for (int creature = 1; creature <= 4; creature++) {
            for (Scheme scheme : ExperimentCatalogue.SCHEMES) {
                EvolvedRun run = results.best(creature, scheme);
                if (run != null) {
                    rows.add(verdict(creature, "best evolved, " + TableFormat.name(scheme) + " (seed "
                            + run.seed() + ")",
                            results.speed(run, ExperimentCatalogue.FLUID),
                            results.speed(run, ExperimentCatalogue.VACUUM),
                            results.motions(run)));
                }
            }
        }
        return rows;
    }

    private List<String> verdict(int creature, String gait, Sample fluid, Sample vacuum, List<SwimKinematics> motions) {
        double relative = fluid.mean() / results.bodyLength(creature);
        String swims = swims(fluid, vacuum);
        return List.of("" + creature, gait, sign(swims) + " " + swims, TableFormat.speed(fluid), TableFormat.speed(vacuum),
                TableFormat.number(relative), TableFormat.shortNumber(relative / results.data().eelBodyLengths()),
                StudyResults.likeWhich(motions, SwimKinematics::fitsOfBody));
    }

    /** What the thesis says, what was measured, and whether it holds. */
    private List<List<String>> claims(Scheme scheme) {
        List<List<String>> rows = new ArrayList<>();
        addEvolved(rows, scheme);
        addParameters(rows, scheme);
        addExperiments(rows, scheme);
        return rows;
    }

    private void addEvolved(List<List<String>> rows, Scheme scheme) {
        List<EvolvedRun> best = new ArrayList<>();
        for (int creature = 1; creature <= 4; creature++) {
            if (results.best(creature, scheme) != null) {
                best.add(results.best(creature, scheme));
            }
        }
        List<SwimKinematics> motions = best.stream().flatMap(run -> results.motions(run).stream()).toList();
        if (motions.isEmpty()) {
            return;
        }
        double yaw = Math.toDegrees(motions.stream().mapToDouble(SwimKinematics::largestYaw).max().orElseThrow());
        double roll = Math.toDegrees(motions.stream().mapToDouble(one -> Math.abs(one.end().roll())).max().orElseThrow());
        rows.add(claim(scheme, "swimming is stable and straight", String.format(Locale.ROOT,
                "largest yaw %.0f°, largest roll at the end %.0f°", yaw, roll), yaw < 30 && roll < 30));
        double swing = motions.stream().mapToDouble(SwimKinematics::tailSwing).min().orElseThrow();
        rows.add(claim(scheme, "amplitudes are wider than real fish'", String.format(Locale.ROOT,
                "least swing %.2f body lengths, an eel's is 0.1", swing), swing > 0.1));
        EvolvedRun fastest = best.stream()
                .max(Comparator.comparingDouble(run -> results.speed(run, ExperimentCatalogue.FLUID).mean()))
                .orElseThrow();
        rows.add(claim(scheme, "creature 1 is fastest", "creature " + fastest.creature() + ", "
                + TableFormat.speed(results.speed(fastest, ExperimentCatalogue.FLUID)), fastest.creature() == 1));
        EvolvedRun two = results.best(2, scheme);
        if (two != null && !results.motions(two).isEmpty()) {
            List<SwimKinematics> swims = results.motions(two);
            double error = StudyResults.error(swims, FishMode.ANGUILLIFORM, SwimKinematics::fitsOfBody).mean();
            boolean eel = StudyResults.like(swims, SwimKinematics::fitsOfBody).filter(FishMode.ANGUILLIFORM::equals).isPresent();
            rows.add(claim(scheme, "creature 2 fits anguilliform fish (e 0.0402)",
                    StudyResults.likeWhich(swims, SwimKinematics::fitsOfBody), eel && error < 0.1));
        }
    }

    private void addParameters(List<List<String>> rows, Scheme scheme) {
        less(rows, scheme, "cohesion hinders", Parameter.COHESION, 0.1, 0.9);
        less(rows, scheme, "surface tension hinders", Parameter.SURFACE_TENSION, 20, 0.9);
        less(rows, scheme, "without viscosity it swims worse", Parameter.VISCOSITY, 0, 0.9);
        less(rows, scheme, "too much viscosity hinders", Parameter.VISCOSITY, 128, 0.9);
        still(rows, scheme, "a body much lighter than the fluid cannot move", Parameter.BODY_MASS, 0.05, 0.3);
        less(rows, scheme, "a larger radius hinders", Parameter.RADIUS, 0.225, 0.9);
        between(rows, scheme, "damping slows a little in fluid, by less than half", Parameter.DAMPING, 8, 0.5, 1.0);
        Sample plain = speed(Parameter.VORTICITY_CONFINEMENT, 0, scheme, false);
        Sample confined = speed(Parameter.VORTICITY_CONFINEMENT, CONFINEMENT, scheme, false);
        if (plain.count() > 1 && confined.count() > 1) {
            rows.add(claim(scheme, "vorticity confinement makes no visible difference (up to a tenth)",
                    TableFormat.speed(confined) + " at " + TableFormat.value(CONFINEMENT) + ", "
                    + TableFormat.speed(plain) + " without",
                    Math.abs(plain.mean() - confined.mean()) <= 0.1 * Math.abs(plain.mean())));
        }
        vacuum(rows, scheme, "damping strongly suppresses the motion in vacuum", Parameter.DAMPING, 8);
        vacuum(rows, scheme, "(found since) the motion in vacuum is the acceleration clamp", Parameter.MAX_ACCELERATION,
                1e30);
    }

    /** Speed of creature 2 with step 0.862, the published gait that swims. */
    private Sample speed(Parameter parameter, double value, Scheme scheme, boolean vacuum) {
        String gait = ExperimentCatalogue.STUDIED_GAITS.get(vacuum ? 0 : 1);
        return results.measurements().speed(ExperimentTables.of(results, parameter, value, gait, scheme, vacuum));
    }

    private void less(List<List<String>> rows, Scheme scheme, String claim, Parameter parameter, double value,
            double share) {
        between(rows, scheme, claim, parameter, value, Double.NEGATIVE_INFINITY, share);
    }

    /** Whether a changed parameter leaves from the one to the other share of the usual speed. */
    private void between(List<List<String>> rows, Scheme scheme, String claim, Parameter parameter, double value, double least,
            double share) {
        Sample usual = speed(parameter, parameter.standard(), scheme, false);
        Sample changed = speed(parameter, value, scheme, false);
        if (usual.count() > 0 && changed.count() > 0) {
            rows.add(claim(scheme, claim, compared(parameter, value, changed, usual), changed.mean() < share * usual.mean() && changed.mean() > least * usual.mean()));
        }
    }

    /** As {@link #less}, in either direction: what goes backwards moves. */
    private void still(List<List<String>> rows, Scheme scheme, String claim, Parameter parameter, double value, double share) {
        Sample usual = speed(parameter, parameter.standard(), scheme, false);
        Sample changed = speed(parameter, value, scheme, false);
        if (usual.count() > 0 && changed.count() > 0) {
            rows.add(claim(scheme, claim, compared(parameter, value, changed, usual),
                    Math.abs(changed.mean()) < share * Math.abs(usual.mean())));
        }
    }

    private static String compared(Parameter parameter, double value, Sample changed, Sample usual) {
        return TableFormat.speed(changed) + " at " + TableFormat.value(value) + ", " + TableFormat.speed(usual) + " at "
                + TableFormat.value(parameter.standard());
    }

    private void vacuum(List<List<String>> rows, Scheme scheme, String claim, Parameter parameter, double value) {
        Sample usual = speed(parameter, parameter.standard(), scheme, true);
        Sample changed = speed(parameter, value, scheme, true);
        if (usual.count() > 0 && changed.count() > 0) {
            rows.add(claim(scheme, claim, compared(parameter, value, changed, usual),
                    Math.abs(usual.mean()) <= STILL ? ABSENT
                            : Math.abs(changed.mean()) < 0.3 * Math.abs(usual.mean()) ? YES : NO));
        }
    }

    private void addExperiments(List<List<String>> rows, Scheme scheme) {
        Sample forwards = potentiated(0, scheme, ExperimentCatalogue.VACUUM);
        Sample backwards = potentiated(1, scheme, ExperimentCatalogue.VACUUM);
        if (forwards.count() > 0 && backwards.count() > 0) {
            rows.add(claim(scheme, "potentiation (p = 4) also accelerates in vacuum, backwards with 1 − Δφ",
                    TableFormat.speed(forwards) + " and " + TableFormat.speed(backwards),
                    Math.abs(forwards.mean()) <= STILL && Math.abs(backwards.mean()) <= STILL ? ABSENT
                            : forwards.mean() * backwards.mean() < 0 ? YES : NO));
        }
        double most = Double.NEGATIVE_INFINITY;
        boolean swims = false;
        List<Experiment> bodies = results.catalogue().twoClusters(scheme);
        for (int i = 0; i < bodies.size(); i += 2) {
            Sample fluid = results.measurements().speed(bodies.get(i));
            most = fluid.count() > 0 ? Math.max(most, fluid.mean()) : most;
            swims |= swims(fluid, results.measurements().speed(bodies.get(i + 1))).equals(YES);
        }
        if (most > Double.NEGATIVE_INFINITY) {
            rows.add(claim(scheme, "a body of two clusters does not swim", "at most " + TableFormat.number(most)
                    + " in fluid", !swims));
        }
    }

    private Sample potentiated(int step, Scheme scheme, String medium) {
        return results.measurements().speed(ExperimentTables.potentiated(results, 1, 4,
                ExperimentCatalogue.PHASE_STEPS.get(step), scheme, medium));
    }

    private static List<String> claim(Scheme scheme, String claim, String measured, boolean holds) {
        return claim(scheme, claim, measured, holds ? YES : NO);
    }

    private static List<String> claim(Scheme scheme, String claim, String measured, String holds) {
        return List.of(claim + " (" + TableFormat.name(scheme) + ")", measured, holds);
    }
}
