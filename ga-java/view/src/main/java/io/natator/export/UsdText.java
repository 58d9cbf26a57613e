package io.natator.export;

import java.util.stream.Collectors;
import java.util.stream.IntStream;

/** Values as USD's text form writes them. */
final class UsdText {

    /** Colours of clusters, from the head on, again from the first after the last. */
    private static final String[] PALETTE = {"(0.894, 0.510, 0.176)", "(0.839, 0.278, 0.302)", "(0.741, 0.290, 0.573)",
        "(0.451, 0.373, 0.725)", "(0.984, 0.737, 0.294)"};

    private UsdText() {
    }

    static String number(float value) {
        return Float.isFinite(value) ? Float.toString(value)
                : Float.isNaN(value) ? "nan" : value > 0 ? "inf" : "-inf";
    }

    static String list(int[] values) {
        return IntStream.of(values).mapToObj(Integer::toString).collect(Collectors.joining(", ", "[", "]"));
    }

    /** So many times the same number. */
    static String list(int count, int value) {
        return list(IntStream.range(0, count).map(i -> value).toArray());
    }

    static String indices(ParticleSet particles) {
        return list(IntStream.range(0, particles.size()).map(particles::index).toArray());
    }

    static String masses(ParticleSet particles) {
        return IntStream.range(0, particles.size()).mapToObj(i -> number(particles.mass(i)))
                .collect(Collectors.joining(", ", "[", "]"));
    }

    static String clusters(ParticleSet particles) {
        return list(IntStream.range(0, particles.size()).map(particles::cluster).toArray());
    }

    /** A colour for each particle's cluster. */
    static String colours(ParticleSet particles) {
        return colours(IntStream.range(0, particles.size()).map(particles::cluster).toArray());
    }

    /** A colour for each of these clusters. */
    static String colours(int[] clusters) {
        return IntStream.of(clusters).mapToObj(cluster -> PALETTE[Math.max(0, cluster) % PALETTE.length])
                .collect(Collectors.joining(", ", "[", "]"));
    }
}
