/**
 * The genetic algorithm of thesis 2.6 on JGAP. Begin with {@link io.natator.evolution.Evolution}; one
 * generation is {@code ThesisBreeder.evolve}.
 */
package io.natator.evolution;
