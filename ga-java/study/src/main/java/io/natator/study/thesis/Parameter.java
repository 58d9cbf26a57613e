package io.natator.study.thesis;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.function.BiConsumer;

/** A parameter of the scene whose influence is studied (thesis 4.1). */
enum Parameter {
    /** Substeps of a frame. */
    SUBSTEPS("substeps", range(4, 1, 2, 3, 4, 6, 8, 16), range(4, 1, 2, 4, 8),
            (scene, value) -> solver(scene).put("substeps", value.intValue())),
    /** Iterations of a substep; in conserving those of the water's pressure. */
    ITERATIONS("iterations", range(4, 1, 2, 3, 4, 6, 8, 16), range(4, 1, 2, 4, 8),
            (scene, value) -> solver(scene).put("numIterations", value.intValue())),
    /** Iterations of the body in a substep, which scheme conserving has by themselves. */
    SOLID_ITERATIONS("iterations of the body", null, range(16, 4, 8, 16, 32),
            (scene, value) -> solver(scene).put("solidIterations", value.intValue())),
    /** Mass of a body particle; the fluid's are as they were. */
    BODY_MASS("body mass", range(1, 0.05, 0.1, 0.25, 0.5, 1, 2, 4, 10), range(0.421875, 0.2109375, 0.31640625, 0.421875, 0.5625, 0.84375),
            (scene, value) -> scene.putObject("creature").put("particleMass", value)),
    /** Cohesion. */
    COHESION("cohesion", range(0, 0, 0.005, 0.01, 0.02, 0.05, 0.1), range(0, 0, 0.02, 0.1),
            (scene, value) -> solver(scene).put("cohesion", value)),
    /** Surface tension. */
    SURFACE_TENSION("surface tension", range(0, 0, 0.1, 0.5, 1, 5, 20), range(0, 0, 1, 5),
            (scene, value) -> solver(scene).put("surfaceTension", value)),
    /** Viscosity, a number without unit that Flex smoothes velocities by. */
    VISCOSITY("viscosity", range(8, 0, 2, 4, 8, 16, 32, 64, 128), null,
            (scene, value) -> solver(scene).put("viscosity", value)),
    /** Kinematic viscosity in squared scene units per second. */
    KINEMATIC_VISCOSITY("kinematic viscosity", null, range(0.002, 0.0005, 0.001, 0.002, 0.004, 0.008, 0.032),
            (scene, value) -> solver(scene).put("kinematicViscosity", value)),
    /** Vorticity confinement. */
    VORTICITY_CONFINEMENT("vorticity confinement", range(0, 0, 1, 5, 20, 80), range(0, 0, 1, 5),
            (scene, value) -> solver(scene).put("vorticityConfinement", value)),
    /** r_r, the radius of interaction. */
    RADIUS("radius", range(0.15, 0.15, 0.16, 0.17, 0.18, 0.2, 0.225), null,
            (scene, value) -> solver(scene).put("radius", value)),
    /** r_r below the distance that the fluid keeps from a body, which follows it down: the thesis' small radius. */
    SMALL_RADIUS("small radius", range(0.15, 0.105, 0.11, 0.12, 0.13, 0.14, 0.15), null,
            (scene, value) -> solver(scene).put("radius", value).put("solidRestDistance", value)),
    /** Support of the kernel in spacings of the water: what the radius is to scheme conserving. */
    KERNEL_SUPPORT("kernel support", null, range(2.5, 2, 2.25, 2.5, 3),
            (scene, value) -> solver(scene).put("kernelSupport", value)),
    /** Damping; in vacuum too. */
    DAMPING("damping", range(1, 0, 0.5, 1, 2, 4, 8), range(0, 0, 0.5, 1, 2, 4, 8),
            (scene, value) -> solver(scene).put("damping", value)),
    /** Friction between particles, and with planes; in vacuum there is nothing to rub. */
    FRICTION("friction", range(0.2, 0, 0.05, 0.1, 0.2, 0.4, 0.8), null,
            (scene, value) -> solver(scene).put("particleFriction", value).put("dynamicFriction", value)),
    /** The acceleration clamp; in vacuum too. The last is as good as none. */
    MAX_ACCELERATION("acceleration clamp", range(100, 25, 50, 100, 200, 400, 1e30), null,
            (scene, value) -> solver(scene).put("maxAcceleration", value));

    private final String label;
    private final Range flex;
    private final Range openWater;
    private final BiConsumer<ObjectNode, Double> patch;

    /**
     * What is tried in a water.
     *
     * @param standard the scene's own
     * @param values   in rising order; the standard is among them
     */
    record Range(double standard, List<Double> values) {

        List<Double> above() {
            return values.stream().filter(value -> value > standard).toList();
        }

        List<Double> below() {
            return values.stream().filter(value -> value < standard).toList();
        }
    }

    Parameter(String label, Range flex, Range openWater, BiConsumer<ObjectNode, Double> patch) {
        this.label = label;
        this.flex = flex;
        this.openWater = openWater;
        this.patch = patch;
    }

    private static Range range(double standard, double... values) {
        return new Range(standard, Arrays.stream(values).boxed().toList());
    }

    private static ObjectNode solver(ObjectNode scene) {
        return scene.has("solver") ? (ObjectNode) scene.get("solver") : scene.putObject("solver");
    }

    String label() {
        return label;
    }

    /** What is tried in a water; empty where the parameter means nothing there. */
    Optional<Range> in(Water water) {
        return Optional.ofNullable(water == Water.FLEX ? flex : openWater);
    }

    /** Whether it is tried without water too: where something moves there. */
    boolean alsoInVacuum(Water water) {
        return water == Water.FLEX && (this == DAMPING || this == MAX_ACCELERATION);
    }

    /** Merge patch on the scene that sets the parameter. */
    ObjectNode overrides(double value) {
        ObjectNode scene = JsonNodeFactory.instance.objectNode();
        patch.accept(scene, value);
        return scene;
    }
}
