package io.natator.export;

import io.natator.stream.StreamField;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.util.stream.IntStream;

/**
 * What is exported of a scene, and what is the same in every frame.
 *
 * @param scene   as streamed
 * @param shown   all exported particles, in the order of their indices
 * @param water   of them, the water
 * @param solids  of them, all others
 * @param surface skin of the body
 */
record ExportContext(StreamScene scene, ParticleSet shown, ParticleSet water, ParticleSet solids, BodySurface surface) {

    /**
     * A scene whose settled start is known.
     *
     * @param water whether the water is exported too
     */
    static ExportContext of(StreamScene scene, StreamFrame start, boolean water) {
        ParticleSet solids = ParticleSet.of(scene, false);
        return new ExportContext(scene, water ? ParticleSet.of(scene, true) : solids,
                water ? ParticleSet.water(scene) : null, solids, BodySurface.of(scene, start.position()));
    }

    boolean hasWater() {
        return water != null && water.size() > 0;
    }

    /** Whether the body comes with the mesh that it was made of. */
    boolean hasSkin() {
        return scene.skin() != null;
    }

    boolean hasVelocity() {
        return scene.has(StreamField.VELOCITY);
    }

    boolean hasDensity() {
        return scene.has(StreamField.DENSITY);
    }

    /** How much shorter than at rest a muscle wants to be, as a share; negative = longer. */
    static float contraction(StreamScene.Muscle muscle, StreamFrame frame) {
        return (float) (-0.5 * muscle.lateral() * frame.activation()[muscle.actuator()]);
    }

    /** Of all muscles in turn, the two particles. */
    int[] muscleEnds() {
        return scene.muscles().stream().flatMapToInt(muscle -> IntStream.of(muscle.a(), muscle.b())).toArray();
    }

    /** The same as places in a set that holds the body. */
    int[] muscleEnds(ParticleSet particles) {
        return IntStream.of(muscleEnds()).map(particles::placeOf).toArray();
    }

    /** Scene and program on one line, for comments in files. */
    String title() {
        String program = scene.program() == null ? "" : ", Natator " + scene.program().path("version").asText();
        return (scene.scene() + program).replaceAll("[^\\x20-\\x7e]|\"", "?");
    }
}
