package io.natator.study.optimizer;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.FreshRuns;
import io.natator.checkpoint.Leader;
import io.natator.checkpoint.StoredRun;
import io.natator.config.EvolutionSettings;
import io.natator.evolution.GenerationSummary;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

/**
 * What is kept of a finished run when its folder is not; a line of {@code SCENE.jsonl}.
 *
 * @param optimizer    label of the variant
 * @param settings     all that determines the run
 * @param environment  where it was carried out, as {@code environment.json}, without the settings
 * @param statistics   what it did not have to simulate, as {@code savings.json}; null if that was not recorded
 * @param best         its best gait, or null if there is none
 * @param generations  figures of each
 * @param improvements where the best gait so far, or its fitness, changed; null where only the generations are known
 */
record RunSummary(@JsonProperty(required = true) String optimizer,
        @JsonProperty(required = true) EvolutionSettings settings, JsonNode environment, JsonNode statistics,
        BestGait best, @JsonProperty(required = true) List<GenerationSummary> generations,
        List<Improvement> improvements) {

    /**
     * An evaluation that changed which gait is the best or how good it is; for the worse, where it was that gait's own, from
     * another start.
     *
     * @param evaluation its number, from 0
     * @param fitness    what the best is worth from then on, never negative
     * @param simulated  time simulated until then in all evaluations, in seconds; null in old studies
     * @param genes      of the best; null where it is the same as before, and in old studies
     */
    @JsonInclude(JsonInclude.Include.NON_NULL)
    record Improvement(@JsonProperty(required = true) int evaluation, @JsonProperty(required = true) double fitness,
            Double simulated, List<Double> genes) {
    }

    /** Of the run in a folder, finished or not. */
    static RunSummary of(String optimizer, Path directory) {
        StoredRun run = StoredRun.in(directory);
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
        return new RunSummary(optimizer, run.settings(), environment,
                run.document("savings.json"), run.best(), run.state() == null ? List.of() : run.state().history(), improvements);
    }

    /** How many evaluations it took. */
    int evaluations() {
        return generations.stream().mapToInt(GenerationSummary::evaluations).sum();
    }

    /**
     * Best fitness after each evaluation: until the last by all that was known of all gaits, then what the run's winner was worth.
     * A run itself forgets gaits that were among the best only for a while, and may end with another one.
     */
    double[] curve() {
        double[] curve = new double[evaluations()];
        for (int i = 0; i < improvements.size(); i++) {
            int end = i + 1 < improvements.size() ? improvements.get(i + 1).evaluation() : curve.length;
            Arrays.fill(curve, improvements.get(i).evaluation(), end, improvements.get(i).fitness());
        }
        if (curve.length > 0 && best != null && best.selected() != null) {
            curve[curve.length - 1] = best.selected();
        }
        return curve;
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
            Double spent = budget == EqualBudget.EVALUATIONS ? Double.valueOf(one.evaluation() + 1.0) : one.simulated();
            if (spent == null || spent > place) {
                break;
            }
            genes = one.genes() != null ? one.genes() : genes;
        }
        return genes;
    }

    /** What the best gait was worth when it was chosen. */
    double selected() {
        double[] curve = curve();
        return curve.length == 0 ? 0 : curve[curve.length - 1];
    }

    /** What the best gait does from fresh starts; null in old studies. */
    FreshRuns fresh() {
        return best == null ? null : best.fresh();
    }

    /** What the best gait does in vacuum, in scene units; NaN if that is not known. */
    double vacuumDistance() {
        return best == null || best.vacuum() == null || best.vacuum().distance() == null ? Double.NaN
                : best.vacuum().distance();
    }
}
