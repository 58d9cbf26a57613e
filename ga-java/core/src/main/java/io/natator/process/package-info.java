/**
 * The native program as processes: one per evaluation, kept alive, or fed with batches; what it says about itself and scenes.
 *
 * <p>How an evaluation of {@code natator evolve} gets there, by default:
 * {@code EvolveCommand.call} → {@code RunLauncher.run} → {@code EvolutionRun.run} → {@code Evolution.run} →
 * {@code Evolution.simulate} → {@code FitnessEvaluator.evaluateAll}, which makes requests of genomes →
 * {@code CachedEvaluator.evaluateAll}, which leaves out known results → {@link io.natator.process.WorkerPool}, whose threads
 * share the rest → {@link io.natator.process.ProcessEvaluator} → {@link io.natator.process.NativeProgram#call}, which starts
 * {@code natator-sim} and writes the request to its standard input.
 */
package io.natator.process;
