package io.natator.study.thesis;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import java.util.List;
import java.util.function.BiConsumer;

/**
 * A parameter of the scene whose influence is studied (thesis 4.1). {@link #standard} is among them.
 */
enum Parameter {
    /** Substeps of a frame. */
    SUBSTEPS("substeps", 4, List.of(1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 16.0), false,
            (scene, value) -> solver(scene).put("substeps", value.intValue())),
    /** Iterations of a substep. */
    ITERATIONS("iterations", 4, List.of(1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 16.0), false,
            (scene, value) -> solver(scene).put("numIterations", value.intValue())),
    /** Mass of a body particle; the fluid's are as they were. */
    BODY_MASS("body mass", 1, List.of(0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 10.0), false,
            (scene, value) -> scene.putObject("creature").put("particleMass", value)),
    /** Cohesion. */
    COHESION("cohesion", 0, List.of(0.0, 0.005, 0.01, 0.02, 0.05, 0.1), false,
            (scene, value) -> solver(scene).put("cohesion", value)),
    /** Surface tension. */
    SURFACE_TENSION("surface tension", 0, List.of(0.0, 0.1, 0.5, 1.0, 5.0, 20.0), false,
            (scene, value) -> solver(scene).put("surfaceTension", value)),
    /** Viscosity. */
    VISCOSITY("viscosity", 8, List.of(0.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0), false,
            (scene, value) -> solver(scene).put("viscosity", value)),
    /** Vorticity confinement. */
    VORTICITY_CONFINEMENT("vorticity confinement", 0, List.of(0.0, 1.0, 5.0, 20.0, 80.0), false,
            (scene, value) -> solver(scene).put("vorticityConfinement", value)),
    /** r_r, the radius of interaction. */
    RADIUS("radius", 0.15, List.of(0.15, 0.16, 0.17, 0.18, 0.2, 0.225), false,
            (scene, value) -> solver(scene).put("radius", value)),
    /** r_r below the distance that the fluid keeps from a body, which follows it down: the thesis' small radius. */
    SMALL_RADIUS("small radius", 0.15, List.of(0.105, 0.11, 0.12, 0.13, 0.14, 0.15), false,
            (scene, value) -> solver(scene).put("radius", value).put("solidRestDistance", value)),
    /** Damping; in vacuum too. */
    DAMPING("damping", 1, List.of(0.0, 0.5, 1.0, 2.0, 4.0, 8.0), true,
            (scene, value) -> solver(scene).put("damping", value)),
    /** Friction between particles, and with planes; in vacuum there is nothing to rub. */
    FRICTION("friction", 0.2, List.of(0.0, 0.05, 0.1, 0.2, 0.4, 0.8), false,
            (scene, value) -> solver(scene).put("particleFriction", value).put("dynamicFriction", value)),
    /** The acceleration clamp; in vacuum too. The last is as good as none. */
    MAX_ACCELERATION("acceleration clamp", 100, List.of(25.0, 50.0, 100.0, 200.0, 400.0, 1e30), true,
            (scene, value) -> solver(scene).put("maxAcceleration", value));

    private final String label;
    private final double standard;
    private final List<Double> values;
    private final boolean alsoInVacuum;
    private final BiConsumer<ObjectNode, Double> patch;

    Parameter(String label, double standard, List<Double> values, boolean alsoInVacuum,
            BiConsumer<ObjectNode, Double> patch) {
        this.label = label;
        this.standard = standard;
        this.values = values;
        this.alsoInVacuum = alsoInVacuum;
        this.patch = patch;
    }

    private static ObjectNode solver(ObjectNode scene) {
        return scene.has("solver") ? (ObjectNode) scene.get("solver") : scene.putObject("solver");
    }

    String label() {
        return label;
    }

    /** What the thesis uses. */
    double standard() {
        return standard;
    }

    List<Double> settings() {
        return values;
    }

    boolean alsoInVacuum() {
        return alsoInVacuum;
    }

    /** Merge patch on the scene that sets the parameter. */
    ObjectNode overrides(double value) {
        ObjectNode scene = JsonNodeFactory.instance.objectNode();
        patch.accept(scene, value);
        return scene;
    }
}
