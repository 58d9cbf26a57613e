package io.natator.compare;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.Leader;
import io.natator.checkpoint.RunReader;
import io.natator.config.EvolutionSettings;
import io.natator.evolution.GenerationSummary;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/**
 * What runs are compared by; part of a line of {@code compare --json}.
 *
 * @param run          its folder
 * @param settings     all that determines the run
 * @param environment  where it was carried out, as {@code environment.json}, without the settings
 * @param statistics   what it did not have to simulate, as {@code savings.json}; null if that was not recorded
 * @param best         its best gait, or null if there is none
 * @param generations  figures of each
 * @param improvements where the best gait so far, or its fitness, changed
 */
record RunSummary(String run, EvolutionSettings settings, JsonNode environment, JsonNode statistics, BestGait best,
        List<GenerationSummary> generations, List<Improvement> improvements) {

    /**
     * An evaluation that changed which gait is the best or how good it is; for the worse, where it was that gait's own, from
     * another start.
     *
     * @param evaluation its number, from 0
     * @param fitness    what the best is worth from then on, never negative
     * @param simulated  time simulated until then in all evaluations, in seconds
     * @param genes      of the best; null where it is the same as before
     */
    @JsonInclude(JsonInclude.Include.NON_NULL)
    record Improvement(int evaluation, double fitness, double simulated, List<Double> genes) {
    }

    /** Summarises the run in a folder, finished or not. */
    static RunSummary of(Path directory) {
        RunReader run = RunReader.in(directory);
        List<Improvement> improvements = new ArrayList<>();
        List<Double> before = null;
        for (Leader one : run.leaders()) {
            improvements.add(new Improvement(one.evaluation(), Math.max(one.worth(), 0), one.simulated(),
                    one.genes().equals(before) ? null : one.genes()));
            before = one.genes();
        }
        JsonNode environment = run.document("environment.json");
        if (environment instanceof ObjectNode all) {
            all.remove("settings");  // which stand beside it
        }
        return new RunSummary(directory.toString(), run.settings(), environment,
                run.document("savings.json"), run.best(), run.state() == null ? List.of() : run.state().history(),
                improvements);
    }

    /** How many evaluations it took. */
    int evaluations() {
        return generations.stream().mapToInt(GenerationSummary::evaluations).sum();
    }

    /** Time simulated in all evaluations, in seconds; NaN if that is not known. */
    double simulated() {
        boolean known = statistics != null && statistics.hasNonNull("simulatedSeconds");
        return known ? statistics.get("simulatedSeconds").asDouble() : Double.NaN;
    }

    /**
     * The gait that the run would have taken for its winner, had it ended earlier.
     *
     * @param place what it would have spent then
     * @return its genes; null if there is none, or it is not known
     */
    List<Double> leader(EqualBudget budget, double place) {
        if (place >= budget.of(this)) {
            return best == null ? null : best.genes();
        }
        List<Double> genes = null;
        for (Improvement one : improvements) {
            double spent = budget == EqualBudget.EVALUATIONS ? one.evaluation() + 1.0 : one.simulated();
            if (spent > place) {
                break;
            }
            genes = one.genes() != null ? one.genes() : genes;
        }
        return genes;
    }
}
