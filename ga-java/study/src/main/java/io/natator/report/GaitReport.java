package io.natator.report;

import io.natator.body.BodyText;
import io.natator.body.ProfileBody;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.StoredRun;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Numbers;
import io.natator.encoding.Gait;
import io.natator.evolution.EliteMap;
import io.natator.evolution.Individual;
import io.natator.file.GeneratedPage;
import io.natator.file.OutputFolder;
import io.natator.file.ShellWord;
import io.natator.flow.FlowField;
import io.natator.kinematics.Attitude;
import io.natator.kinematics.FishMode;
import io.natator.kinematics.ModeFit;
import io.natator.kinematics.Swimming;
import io.natator.simulator.SceneInfo;
import io.natator.simulator.SimulationRequest;
import io.natator.verdict.ControlVerdict;
import io.natator.verdict.FreshText;
import io.natator.verdict.Measure;
import io.natator.verdict.Reproduction;
import io.natator.verdict.Refusals;
import io.natator.verdict.Verdict;
import io.natator.verdict.WinnerFacts;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.stream.Collectors;

/** What came of a run: its best gait recorded once more, with the thesis' pictures and numbers. */
public final class GaitReport {

    private static final double ROUNDING = 1e-5;
    private static final Map<Measure.Outcome, String> OUTCOMES = Map.of(Measure.Outcome.HOLDS, "holds", Measure.Outcome.FAILS,
            "does not", Measure.Outcome.NOT_MEASURED, "not measured");

    private final StoredRun run;
    private final Path folder;
    private String difference;

    /**
     * A report on a run.
     *
     * @param folder where {@code README.md}, {@code report.html} and the pictures go
     * @throws InvalidInputException if the run has no best gait or no checkpoint yet, or the folder has a page of somebody's own
     */
    public GaitReport(StoredRun run, Path folder) {
        run.requiredBest();
        if (run.state() == null) {
            throw new InvalidInputException(run.directory() + " has no checkpoint yet; finish it by natator resume");
        }
        GeneratedPage.check(folder);
        this.run = run;
        this.folder = folder;
    }

    /**
     * Records the best gait on the processor, draws and writes.
     *
     * @param execution with a time limit
     * @return the Markdown page
     * @throws IOException          if a file cannot be written
     * @throws InterruptedException if the calling thread is interrupted
     */
    public Path write(ExecutionSettings execution) throws IOException, InterruptedException {
        EvolutionSettings settings = run.settings();
        SceneInfo scene = SceneInfo.of(settings.scene(), settings.overrides(), execution.simulator());
        double duration = settings.duration() != null ? settings.duration() : scene.duration();
        OutputFolder.make(folder);
        SimulationRequest request = SimulationRequest.of(0, settings, run.best().swimmer()).withoutStops();
        Recording recording = RecordingFactory.of(request, duration / 2, execution);
        ReportDocument page = new ReportDocument(folder, settings.scene() + ", seed " + settings.seed());
        difference = difference(recording, execution);
        progress(page);
        Path swimmer = folder.resolve("swimmer.png");
        FirstScreen.add(page, answer(), swimmer, "the swimmer in its tank", evidence());
        if (!Files.exists(swimmer)) {
            page.text("The swimmer is shown above if it is drawn before: `python -m natator picture " + ShellWord.of(run.directory())
                    + " --from three-quarter -o " + ShellWord.of(swimmer) + "`.");
        }
        course(page);
        motion(page, recording);
        flow(page, recording);
        numbers(page, recording);
        page.text(GeneratedPage.MARK);
        return page.write(GeneratedPage.NAME);
    }

    private Controls controls() {
        return Controls.of(run.directory(), run.best().swimmer());
    }

    private FirstScreen.Evidence evidence() {
        return new FirstScreen.Evidence(List.of("measure", "value", "of a swimmer", "outcome"),
                Measure.of(run.best(), controls()).stream().map(one -> List.of(one.name(), one.value(), one.expected(),
                        FirstScreen.SIGNS.get(one.outcome()) + " " + OUTCOMES.get(one.outcome()))).toList(),
                "After ± stands a standard deviation.");
    }

    /** What came of it, in a few sentences. */
    private List<String> answer() {
        Verdict verdict = Verdict.of(run.best());
        Controls controls = controls();
        Map<String, String> facts = WinnerFacts.of(run.directory(), run.best());
        List<String> sentences = new ArrayList<>();
        sentences.add("**The best gait " + (verdict.text().startsWith("not ") ? "is " : "") + verdict.text() + "**" + (run.best().fresh() == null ? " (one run, not a mean)." : "."));
        if (run.best().fresh() != null && run.best().fresh().base().perBeat() != null) {
            sentences.add("It gets " + Numbers.significant(run.best().fresh().base().perBeat().mean(), 3)
                    + " body lengths further in a beat, at " + Numbers.significant(run.best().gait().frequency(), 3) + " beats a second.");
        }
        sentences.add(controls == null ? "Its controls were not run; `natator check " + run.directory() + "` runs them."
                : "By its controls it " + ControlVerdict.of(controls).text() + ".");
        if (facts.containsKey("finer steps")) {
            sentences.add("At finer steps: " + facts.get("finer steps") + ".");
        }
        if (facts.containsKey("cost")) {
            String cost = facts.get("cost");
            sentences.add(cost.substring(0, 1).toUpperCase(Locale.ROOT) + cost.substring(1) + ".");
        }
        String refused = Refusals.of(run.state());
        if (refused != null) {
            sentences.add("The run " + refused + ".");
        }
        sentences.add(difference != null ? difference + "." : verdict.advice() != null ? "To go on: " + verdict.advice() + "." : "");
        return sentences;
    }

    /** Once written: what today's program did otherwise than the run has stored, on one line; null if nothing. */
    public String difference() {
        return difference;
    }

    private String difference(Recording recording, ExecutionSettings execution) throws InterruptedException {
        Reproduction stored = new Reproduction(run.directory(), run.best(), execution.simulator(), Backend.CPU, 0);
        double[][] centres = recording.centres();
        int last = (int) stored.lastFrame();
        return last < 0 || last >= centres.length ? null
                : stored.difference(centres[last][0] - centres[0][0], ROUNDING);
    }

    /** Whoever reads of a run that is not finished is told so first. */
    private void progress(ReportDocument page) {
        if (!run.state().isLastOf(run.settings())) {
            page.text("**This run is not finished.** Done are generation " + run.state().generation()
                    + (run.settings().generations() == EvolutionSettings.NO_LIMIT ? ""
                            : " of " + run.settings().generations())
                    + " and " + Numbers.count(run.state().evaluations(), "evaluation") + "; this is the best gait so far. It goes on by `natator "
                    + "resume " + run.directory() + "`.");
        }
    }

    private void course(ReportDocument page) throws IOException {
        page.heading(2, "Course of the run");
        FitnessPlot.draw(run.settings(), run.state().history(), folder);
        page.picture(folder.resolve("fitness.png"), "fitness over generations");
        List<Individual> front = run.front();
        for (int other = 1; !front.isEmpty() && other < run.settings().objectives().size(); other++) {
            page.picture(FrontPlot.draw("gaits that no other is better than in all objectives", run.settings().objectives(),
                    run.state().population(), front, 0, other, folder.resolve("front-" + other)),
                    "all gaits and those that no other is better than, in two objectives");
        }
        EliteMap elites = run.elites();
        if (elites != null && !elites.moving().isEmpty()) {
            page.picture(EliteMapPlot.draw(elites, folder.resolve("elites")),
                    "worth of the best gait of each kind, by beats per body length and cost of transport");
        }
    }

    private void motion(ReportDocument page, Recording recording) throws IOException {
        MotionPlots plots = new MotionPlots(run.settings().scene(), recording, folder);
        page.heading(2, "Motion").picture(plots.position("position"), "position over time");
        page.picture(plots.rotation("rotation"), "rotation over time");
        page.picture(plots.spines("spines"), "spine in four phases with its envelope");
        List<ModeFit> fits = fits(recording);
        Optional<ModeFit> nearest = ModeFit.nearest(fits);
        page.heading(2, "Beside real fish").text((nearest.isPresent() ? "It moves like **" + nearest.get().mode().label() + "** fish"
                : "It moves like **none** of the " + FishMode.values().length + " kinds of fish")
                + ": of " + fits.stream().map(GaitReport::told).collect(Collectors.joining(", "))
                + ". e is how far the motion is from the fish's: 0 is the same motion, " + number(fits.get(0).none())
                + " is no motion at all; like a fish is what has at most four fifths of that and needs not be scaled to less than a "
                + "tenth. α scales the simulated spine; the body's roll is taken out.");
        page.text(String.format(Locale.ROOT, "The simulated curves end at %.2f of the length: bent, the spine is so much shorter "
                + "along its line, and beyond that its motion is not known at all times (thesis 2.8).", plots.measuredPart()));
        page.picture(plots.envelopes("envelopes"), "envelope against real fish");
        if (nearest.isPresent()) {
            page.picture(plots.scaled("scaled", nearest.get().mode()), "scaled against the nearest real fish");
        }
    }

    private static String told(ModeFit fit) {
        return String.format(Locale.ROOT, "%s e %.4f (α %.2f)", fit.mode().label(), fit.error(), fit.alpha());
    }

    private void flow(ReportDocument page, Recording recording) throws IOException {
        if (!recording.flow().isEmpty()) {
            page.heading(2, "Water");
        }
        for (FlowField field : recording.flow()) {
            String name = "flow-" + field.view().name().toLowerCase(Locale.ROOT);
            page.picture(FlowPlot.draw(run.settings().scene(), field, folder.resolve(name)),
                    "velocity and vorticity of the fluid " + field.view().label());
        }
    }

    private List<ModeFit> fits(Recording recording) {
        return ModeFit.all(new Swimming(recording.unrolled()), run.best().gait().frequency());
    }

    private void numbers(ReportDocument page, Recording recording) {
        BestGait best = run.best();
        Gait gait = best.gait();
        double length = recording.spine().restLength();
        Attitude end = recording.attitude().get(recording.attitude().size() - 1);
        List<List<String>> rows = new ArrayList<>();
        rows.add(List.of("generations, evaluations", run.state().generation() + ", " + run.state().evaluations()));
        rows.add(List.of("frequency (1/s)", number(gait.frequency())));
        rows.add(List.of("amplitudes", numbers(gait.amplitude())));
        rows.add(List.of("phases", numbers(gait.phase())));
        if (gait.offset() != null) {
            rows.add(List.of("offsets", numbers(gait.offset())));
        }
        if (run.settings().evolve() != null) {
            ProfileBody scene = run.settings().evolve().body();
            BodyText.of(scene.with(best.body()), scene).forEach((name, text) -> rows.add(List.of("body: " + name, text)));
        }
        FreshText.of(best).forEach((name, text) -> rows.add(List.of(name + " in fluid", text)));
        if (best.fresh() == null) {
            rows.add(List.of("speed in fluid (units/s), one run", number(best.speed())));
            rows.add(List.of("speed in fluid (body lengths/s), one run", number(best.speed() / length)));
        }
        WinnerFacts.mechanics(best).forEach((name, text) -> rows.add(List.of(name, text)));
        if (best.vacuum() != null) {
            rows.add(List.of("speed in vacuum (units/s)", number(best.vacuum().speed())));
        }
        for (ModeFit fit : fits(recording)) {
            rows.add(List.of("e against " + fit.mode().label() + " fish (α, β)", String.format(Locale.ROOT,
                    "%.4f (%.2f, %.2f s)", fit.error(), fit.alpha(), fit.beta())));
        }
        rows.add(List.of("turned at the end, θ ρ ω (degrees)", String.format(Locale.ROOT, "%.1f %.1f %.1f",
                Math.toDegrees(end.roll()), Math.toDegrees(end.yaw()), Math.toDegrees(end.pitch()))));
        page.heading(2, "Numbers").folded("all numbers", inside -> inside.table(List.of("", "value"), rows));
        page.heading(2, "Command").code("java -jar ga-java/target/natator.jar report " + run.directory());
    }

    private static String number(double value) {
        return Numbers.fixed(value, 4);
    }

    private static String numbers(List<Double> values) {
        return values.stream().map(GaitReport::number).collect(Collectors.joining(" "));
    }
}
