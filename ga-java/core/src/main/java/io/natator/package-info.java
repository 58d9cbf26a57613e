/**
 * Natator evolves gaits of swimming soft bodies. Programs that embed it begin with {@link io.natator.Natator}.
 *
 * <p>{@link io.natator.config} holds settings, {@link io.natator.encoding} genes and gaits,
 * {@link io.natator.simulator} evaluations by the native program, {@link io.natator.cache} those that need not be
 * repeated, {@link io.natator.evolution} the optimizers, {@link io.natator.checkpoint} run folders and
 * {@link io.natator.run} evolutions in them, {@link io.natator.file} how all files are written and read,
 * {@link io.natator.kinematics} how a body moves, and {@link io.natator.verdict} whether that is swimming.
 */
package io.natator;
