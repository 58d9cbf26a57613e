package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.base.Numbers;
import io.natator.body.BodyText;
import io.natator.body.ProfileBody;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.RunReader;
import io.natator.config.Budget;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.config.WeightedObjective;
import io.natator.evolution.EliteMap;
import io.natator.evolution.Individual;
import io.natator.protocol.SimulationRequest;
import io.natator.verdict.FreshText;
import io.natator.verdict.Measure;
import io.natator.verdict.Refusals;
import io.natator.verdict.Verdict;
import io.natator.verdict.WinnerFacts;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Objects;

/** What {@code show --json} tells of a run, for programs: its report is made of it. */
final class RunDocument {

    private static final Map<Measure.Outcome, String> OUTCOMES = Map.of(Measure.Outcome.HOLDS, "holds",
            Measure.Outcome.FAILS,
            "does not", Measure.Outcome.NOT_MEASURED, "not measured");

    private final RunReader run;
    private final BestGait best;

    /**
     * The document of a run.
     *
     * @throws InvalidInputException if it has no best gait or no checkpoint yet
     */
    RunDocument(RunReader run) {
        this.run = run;
        this.best = run.requiredBest();
        if (run.state() == null) {
            throw new InvalidInputException(run.directory() + " has no checkpoint yet; finish it by natator resume");
        }
    }

    /** On one line. */
    String json() {
        EvolutionSettings settings = run.settings();
        Map<String, Object> document = new LinkedHashMap<>();
        document.put("title", settings.problem().scene() + ", seed " + settings.search().seed());
        document.put("unfinished", unfinished());
        document.put("answer", answer());
        document.put("measures", Measure.of(best, Controls.of(run.directory(), best.swimmer())).stream()
                .map(one -> List.of(one.name(), one.value(), one.expected(), OUTCOMES.get(one.outcome()))).toList());
        document.put("numbers", numbers());
        document.put("request", SimulationRequest.of(0, settings, best.swimmer()).withoutStops());
        document.put("generations", run.state().history());
        document.put("worth", settings.problem().objectives() == null ? "distance (scene units)"
                : "worth by " + WeightedObjective.text(WeightedObjective.leading(settings.problem().objectives())));
        List<Individual> front = run.front();
        if (!front.isEmpty()) {
            document.put("objectives",
                    settings.problem().objectives().stream().map(one -> EnumNames.of(one.objective())).toList());
            document.put("population",
                    run.state().population().stream().map(Individual::objectives).filter(Objects::nonNull).toList());
            document.put("front", front.stream().map(Individual::objectives).toList());
        }
        EliteMap elites = run.elites();
        if (elites != null && !elites.moving().isEmpty()) {
            List<Map<String, Object>> cells = new ArrayList<>();
            elites.moving()
                    .forEach((cell, elite) -> cells
                            .add(Map.of("beats", EliteMap.edge(cell.beats()), "cost", EliteMap.edge(cell.cost()),
                                    "worth", elite.score())));
            document.put("elites", cells);
        }
        return Json.line(document);
    }

    /** Null of a run that has come to its end. */
    private String unfinished() {
        return run.state().isLastOf(run.settings()) ? null
                : "This run is not finished. Done are generation " + run.state().generation()
                        + (run.settings().budget().generations() == Budget.NO_LIMIT ? ""
                                : " of " + run.settings().budget().generations())
                        + " and " + Numbers.count(run.state().evaluations(), "evaluation")
                        + "; this is the best gait so far. It goes on by natator resume " + run.directory() + ".";
    }

    /** What came of it, in a few sentences. */
    private List<String> answer() {
        Verdict verdict = Verdict.of(best);
        Map<String, String> facts = WinnerFacts.of(run.directory(), best);
        List<String> sentences = new ArrayList<>();
        sentences.add("The best gait " + (verdict.text().startsWith("not ") ? "is " : "") + verdict.text()
                + (best.fresh() == null ? " (one run, not a mean)." : "."));
        if (best.fresh() != null && best.fresh().base().perBeat() != null) {
            sentences.add("It gets " + Numbers.significant(best.fresh().base().perBeat().mean(), 3)
                    + " body lengths further in a beat, at "
                    + Numbers.significant(best.gait().frequency(), 3) + " beats a second.");
        }
        sentences.add(facts.containsKey("controls") ? "By its controls it " + facts.get("controls") + "."
                : "Its controls were not run; natator check " + run.directory() + " runs them.");
        if (facts.containsKey("finer steps")) {
            sentences.add("At finer steps: " + facts.get("finer steps") + ".");
        }
        if (facts.containsKey("cost")) {
            sentences.add(
                    facts.get("cost").substring(0, 1).toUpperCase(Locale.ROOT) + facts.get("cost").substring(1) + ".");
        }
        String refused = Refusals.of(run.state());
        if (refused != null) {
            sentences.add("The run " + refused + ".");
        }
        if (verdict.advice() != null) {
            sentences.add("To go on: " + verdict.advice() + ".");
        }
        return sentences;
    }

    private List<List<String>> numbers() {
        List<List<String>> rows = new ArrayList<>();
        rows.add(List.of("generations, evaluations", run.state().generation() + ", " + run.state().evaluations()));
        rows.add(List.of("frequency (1/s)", RunReport.number(best.gait().frequency())));
        rows.add(List.of("amplitudes", RunReport.row(best.gait().amplitude())));
        rows.add(List.of("phases", RunReport.row(best.gait().phase())));
        if (best.gait().offset() != null) {
            rows.add(List.of("offsets", RunReport.row(best.gait().offset())));
        }
        if (run.settings().problem().evolve() != null) {
            ProfileBody scene = run.settings().problem().evolve().body();
            BodyText.of(scene.with(best.body()), scene)
                    .forEach((name, text) -> rows.add(List.of("body: " + name, text)));
        }
        FreshText.of(best).forEach((name, text) -> rows.add(List.of(name + " in fluid", text)));
        if (best.fresh() == null) {
            rows.add(List.of("speed in fluid (units/s), one run", RunReport.number(best.speed())));
        }
        WinnerFacts.mechanics(best).forEach((name, text) -> rows.add(List.of(name, text)));
        if (best.vacuum() != null) {
            rows.add(List.of("speed in vacuum (units/s)", RunReport.number(best.vacuum().speed())));
        }
        return rows;
    }
}
