package io.natator.evolution;

import io.natator.encoding.Gait;
import io.natator.simulator.SimulationResult;
import java.util.List;

/**
 * One simulation of an evolution; one line of {@code evaluations.jsonl}.
 *
 * @param generation the generation that it was for
 * @param genes      gene values in the order of the encoding
 * @param gait       what they stand for
 * @param result     what came of it; its id is the number of the simulation in the evolution, from 0
 */
public record EvaluationRecord(int generation, List<Double> genes, Gait gait, SimulationResult result) {

    /** Copies the genes. */
    public EvaluationRecord {
        genes = List.copyOf(genes);
    }
}
