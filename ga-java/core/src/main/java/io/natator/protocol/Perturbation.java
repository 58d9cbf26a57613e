package io.natator.protocol;

/**
 * Random shift of all starting positions, for ensembles of a chaotic system.
 *
 * @param amplitude largest shift along each axis in scene units, at least 0
 * @param seed      the same seed gives the same shifts; at least 0
 */
public record Perturbation(double amplitude, long seed) {
}
