package io.natator.checkpoint;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.body.Swimmer;
import io.natator.encoding.Gait;
import io.natator.evolution.Individual;
import io.natator.protocol.SimulationResult;
import java.util.List;
import java.util.Objects;

/**
 * The best gait of a run; {@code best.json}. What is to be reported of it is {@code fresh}; {@code result} is one run,
 * to be watched.
 *
 * @param scene    the scene that it swam in
 * @param genes    gene values in the order of the encoding
 * @param gait     what they stand for
 * @param body     JSON Merge Patch that gives the scene the body that swam; null for the scene's own
 * @param distance signed distance swum in {@code result}, in scene units
 * @param speed    distance over simulated time in {@code result}, in scene units per second
 * @param result   the whole result of a run from the scene's own start; while a run of several starts goes on, of one of
 *                 these
 * @param bodyLength of its creature, head to tail at rest, in scene units; null while the run goes on
 * @param vacuum   result of the same gait without water for as long as it swam, where a gait that still advances is no swimming (thesis 2.7);
 *                 null while the run goes on, and for scenes that have no such variant
 * @param selected its worth when it was chosen
 * @param runs     how many runs that rests on
 * @param fresh    what it does from starts that had no part in choosing it; null while the run goes on
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record BestGait(String scene, List<Double> genes, Gait gait, JsonNode body, double distance, double speed,
        SimulationResult result, Double bodyLength, SimulationResult vacuum, double selected, int runs,
        FreshRuns fresh) {

    /** Requires scene, genes, gait and result. */
    public BestGait {
        Objects.requireNonNull(scene, "scene");
        Objects.requireNonNull(genes, "genes");
        Objects.requireNonNull(gait, "gait");
        Objects.requireNonNull(result, "result");
    }

    /** The best gait as far as evolution tells. */
    public static BestGait of(String scene, Individual best, Swimmer swimmer) {
        return new BestGait(scene, best.genes(), swimmer.gait(), swimmer.body(), best.result().distance(),
                best.result().speed(), best.result(), null, null, best.score(), best.runs(), null);
    }

    /**
     * With what is found out at the end of a run.
     *
     * @param own from the scene's own start
     */
    public BestGait withExamination(SimulationResult own, Double length, SimulationResult withoutWater,
            FreshRuns again) {
        return new BestGait(scene, genes, gait, body, own.distanceOrZero(), own.speed(), own, length, withoutWater,
                selected, runs, again);
    }

    /** Whether this is an individual of a run with all that is found out at the end. */
    public boolean isExamined(Individual best) {
        return fresh != null && vacuum != null && vacuum.status() == SimulationResult.Status.OK
                && genes.equals(best.genes()) && best.score() == selected && best.runs() == runs;
    }

    /** The swimmer: gait and body. */
    public Swimmer swimmer() {
        return new Swimmer(gait, body);
    }
}
