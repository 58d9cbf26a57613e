package io.natator.export;

import java.util.stream.Collectors;
import java.util.stream.IntStream;

/** Values as USD's text form writes them. */
final class UsdText {

    private UsdText() {
    }

    /** A text of one line. */
    static String quoted(String text) {
        return '"' + text.replace("\\", "\\\\").replace("\"", "\\\"") + '"';
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

    static String creatures(ParticleSet particles) {
        return list(IntStream.range(0, particles.size()).map(particles::creature).toArray());
    }

    /** A colour for each particle's cluster. */
    static String colours(ParticleSet particles) {
        return colours(IntStream.range(0, particles.size()).map(particles::cluster).toArray());
    }

    /** A colour for each of these clusters. */
    static String colours(int[] clusters) {
        return IntStream.of(clusters).mapToObj(ClusterColours::of)
                .map(colour -> "(" + colour[0] + ", " + colour[1] + ", " + colour[2] + ")")
                .collect(Collectors.joining(", ", "[", "]"));
    }
}
