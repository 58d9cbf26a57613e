package io.natator.evolution;

import io.natator.simulator.SimulationResult;
import java.util.List;

/** Simulates the new chromosomes of a generation. */
@FunctionalInterface
interface GenerationEvaluator {

    /**
     * Simulates them, in order, as far as the run's number of evaluations goes.
     *
     * @param genomes gene values
     * @return one result for each in the same order, or for as many of the first as may still be simulated
     */
    List<SimulationResult> evaluate(List<List<Double>> genomes);
}
