package io.natator.evolution;

import java.util.List;

/** Simulates the new chromosomes of a generation. */
@FunctionalInterface
interface GenerationEvaluator {

    /**
     * Simulates them, in order, as far as the run's number of evaluations goes.
     *
     * @param genomes gene values
     * @return them as newborns, in the same order, or as many of the first as may still be simulated
     */
    List<Individual> evaluate(List<List<Double>> genomes);
}
