/**
 * Natator evolves gaits of swimming soft bodies. Programs that embed it begin with {@link io.natator.Natator}.
 *
 * <p>Each package needs only those before it: {@link io.natator.base} numbers as text and bad input,
 * {@link io.natator.encoding} genes and gaits, {@link io.natator.body} bodies, {@link io.natator.config} settings,
 * {@link io.natator.file} how all files are written and read, {@link io.natator.protocol} requests and results,
 * {@link io.natator.process} the native program that answers them, {@link io.natator.fitness} what is asked beside the
 * distance, {@link io.natator.cache} evaluations that need not be repeated, {@link io.natator.evolution} the optimizers,
 * {@link io.natator.checkpoint} run folders, {@link io.natator.verdict} whether their best swims, and
 * {@link io.natator.run} evolutions in them.
 */
package io.natator;
