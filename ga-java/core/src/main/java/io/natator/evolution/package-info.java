/**
 * The loop of generations, {@link io.natator.evolution.Evolution}, and its optimizers: the genetic algorithm of thesis 2.6 on JGAP
 * ({@code GeneticAlgorithm}, {@code ThesisBreeder.evolve}), CMA-ES, random search, MAP-Elites, and programs outside.
 */
package io.natator.evolution;
