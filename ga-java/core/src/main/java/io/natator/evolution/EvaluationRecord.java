package io.natator.evolution;

import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.encoding.Gait;
import io.natator.protocol.SimulationResult;
import java.util.List;
import java.util.Objects;

/**
 * One simulation of an evolution; one line of {@code evaluations.jsonl}.
 *
 * @param generation the generation that it was for
 * @param genes      gene values in the order of the encoding
 * @param gait       what they stand for
 * @param result     what came of it; its id is the number of the simulation in the evolution, from 0
 * @param start      from which of many starts; null for the scene's own
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record EvaluationRecord(int generation, List<Double> genes, Gait gait, SimulationResult result, Integer start) {

    /** Copies the genes; requires them, a gait, and a result with its id. */
    public EvaluationRecord {
        genes = List.copyOf(Objects.requireNonNull(genes, "genes"));
        Objects.requireNonNull(gait, "gait");
        Objects.requireNonNull(result, "result");
        Objects.requireNonNull(result.id(), "id");
    }
}
