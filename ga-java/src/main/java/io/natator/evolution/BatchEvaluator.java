package io.natator.evolution;

import io.natator.simulator.SimulationResult;
import java.util.List;

/** Simulates the new chromosomes of a generation. */
@FunctionalInterface
interface BatchEvaluator {

    /**
     * Simulates all of them.
     *
     * @param genomes distinct gene values
     * @return one result for each, in the same order
     */
    List<SimulationResult> evaluate(List<List<Double>> genomes);
}
