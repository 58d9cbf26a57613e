package io.natator.export;

import io.natator.config.InvalidInputException;
import io.natator.stream.StreamField;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.IntStream;

/**
 * What is exported of a scene, and what is the same in every frame.
 *
 * @param scene        as streamed
 * @param shown        all exported particles, in the order of their indices
 * @param water        of them, the water
 * @param solids       of them, all others
 * @param surfaces     skin of the swimmer, and after it of each companion
 * @param surface      all of these
 * @param waterSurface of the water, or null if it is not exported
 * @param python       for what needs it
 */
record ExportContext(StreamScene scene, ParticleSet shown, ParticleSet water, ParticleSet solids,
        List<BodySurface> surfaces, BodySurface surface, WaterSurface waterSurface, Python python) {

    /**
     * A scene whose settled start is known.
     *
     * @param content what of it is exported
     * @throws InvalidInputException if it does not have that
     */
    static ExportContext of(StreamScene scene, StreamFrame start, ExportContent content, Python python)
            throws IOException {
        if (content.waterSurface() && scene.fluidCount() == 0) {
            throw new InvalidInputException("--water-surface: " + scene.scene() + " has no water; expected some");
        }
        ParticleSet solids = ParticleSet.of(scene, false);
        boolean water = content.water();
        List<BodySurface> surfaces = new ArrayList<>(List.of(BodySurface.of(scene, start.position())));
        scene.companions().forEach(one -> surfaces.add(BodySurface.of(scene, one.slices(), start.position())));
        return new ExportContext(scene, water ? ParticleSet.of(scene, true) : solids,
                water ? ParticleSet.water(scene) : null, solids, surfaces, BodySurface.joined(surfaces),
                content.waterSurface() ? new WaterSurface(scene, python) : null, python);
    }

    boolean hasWaterSurface() {
        return waterSurface != null;
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

    /** Scene and program on one line, for comments in files; characters without a form are question marks. */
    String title() {
        String program = scene.program() == null ? "" : ", Natator " + scene.program().path("version").asText();
        return (scene.scene() + program).replaceAll("[\\p{Cc}\\p{Cs}\\u2028\\u2029]", "?");
    }
}
