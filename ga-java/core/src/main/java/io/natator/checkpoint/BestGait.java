package io.natator.checkpoint;

import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.encoding.Gait;
import io.natator.evolution.Individual;
import io.natator.simulator.SimulationResult;
import java.util.List;

/**
 * The best gait of a run; {@code best.json}.
 *
 * @param scene    the scene that it swam in
 * @param genes    gene values in the order of the encoding
 * @param gait     what they stand for
 * @param distance signed distance swum in scene units
 * @param speed    distance over simulated time, in scene units per second
 * @param result   the whole result of its evaluation
 * @param bodyLength of its creature, head to tail at rest, in scene units; null while the run goes on, and in old folders
 * @param vacuum   result of the same gait without water for as long as it swam, where a gait that still advances is no swimming (thesis 2.7);
 *                 null while the run goes on, and for scenes that have no such variant
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record BestGait(String scene, List<Double> genes, Gait gait, double distance, double speed,
        SimulationResult result, Double bodyLength, SimulationResult vacuum) {

    /** The best gait as far as evolution tells. */
    public static BestGait of(String scene, Individual best, Gait gait, Double bodyLength,
            SimulationResult vacuum) {
        return new BestGait(scene, best.genes(), gait, best.result().distance(), best.result().speed(), best.result(),
                bodyLength, vacuum);
    }
}
