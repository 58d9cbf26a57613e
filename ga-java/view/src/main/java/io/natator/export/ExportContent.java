package io.natator.export;

/**
 * What of a swim is exported.
 *
 * @param water        the water's particles
 * @param waterSurface the water's surface as a mesh
 */
public record ExportContent(boolean water, boolean waterSurface) {
}
