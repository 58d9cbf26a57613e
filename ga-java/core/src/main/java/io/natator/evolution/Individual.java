package io.natator.evolution;

import io.natator.simulator.SimulationResult;
import java.util.List;

/**
 * An evaluated chromosome.
 *
 * @param genes  gene values in the order of the encoding
 * @param age    generations survived since birth; random first ones start at 1, since JGAP does not cross newborns
 * @param result what came of its evaluation
 */
public record Individual(List<Double> genes, int age, SimulationResult result) {

    /** Copies the genes. */
    public Individual {
        genes = List.copyOf(genes);
    }
}
