package io.natator.study.thesis;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.encoding.Gait;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.VacuumRequests;
import java.util.List;

/** What a gait is measured under, to tell swimming from what only looks like it. */
enum Condition {
    /** In its water. */
    WATER("water"),
    /** With muscles that do nothing: what a dead body drifts. */
    RESTING("resting"),
    /** Without water, gravity and planes. */
    VACUUM("vacuum"),
    /** Without the clamp of accelerations, which scheme flex alone has. */
    NO_CLAMP("no-clamp"),
    /** With twice the substeps. */
    HALF_STEP("half-step"),
    /** With left and right exchanged. */
    MIRRORED("mirrored"),
    /** In the other water, where the body is as heavy and stiff as the other scene has it. */
    OTHER_WATER("other-water"),
    /** In the tank with inverse masses linear in height, as the thesis may have meant its masses. */
    INVERSE_MASS("inverse-mass");

    private static final double NO_LIMIT = 3.4028234663852886e38;

    private final String label;

    Condition(String label) {
        this.label = label;
    }

    /** In the files of the study. */
    String label() {
        return label;
    }

    /** Those that mean anything in a water. */
    static List<Condition> in(Water water) {
        return water == Water.FLEX ? List.of(values())
                : List.of(WATER, RESTING, VACUUM, HALF_STEP, MIRRORED, OTHER_WATER);
    }

    /**
     * What is asked for.
     *
     * @param subject  that swims
     * @param duration simulated seconds, or null for the scene's own
     */
    SimulationRequest of(Subject subject, Double duration) {
        SimulationRequest plain = plain(subject, subject.water(), duration);
        return switch (this) {
            case WATER -> plain;
            case RESTING -> withGait(plain, subject.gait().resting());
            case VACUUM -> VacuumRequests.of(plain, duration);
            case NO_CLAMP -> plain.withChange(solver("maxAcceleration", NO_LIMIT));
            case HALF_STEP -> plain.withChange(solver("substeps", 2 * Water.SUBSTEPS));
            case MIRRORED -> withGait(plain, subject.gait().mirrored());
            case OTHER_WATER -> plain(subject, subject.water().other(), duration);
            case INVERSE_MASS -> plain.withChange(inverseMass());
        };
    }

    /**
     * A gait in a scene as it is. One that evolved ends where it touches a plane, as it did when it evolved; a published one runs
     * on, as it was measured with Flex.
     */
    private static SimulationRequest plain(Subject subject, Water water, Double duration) {
        return new SimulationRequest(0, water.scene(subject.creature()), subject.gait(), duration, water.scheme(),
                stopping(subject.isEvolved()));
    }

    /** A patch that leaves a run its whole time, but for touching a plane if that is to end it. */
    static ObjectNode stopping(boolean touchEnds) {
        ObjectNode patch = JsonNodeFactory.instance.objectNode();
        patch.putObject("stopping").put("planeContact", touchEnds).put("noProgressAfter", 0);
        return patch;
    }

    private static SimulationRequest withGait(SimulationRequest request, Gait gait) {
        return new SimulationRequest(0, request.scene(), gait, request.duration(), request.scheme(), request.overrides());
    }

    private static ObjectNode solver(String key, double value) {
        ObjectNode patch = JsonNodeFactory.instance.objectNode();
        ObjectNode solver = patch.putObject("solver");
        if (value == Math.rint(value) && value < Integer.MAX_VALUE) {
            solver.put(key, (int) value);
        } else {
            solver.put(key, value);
        }
        return patch;
    }

    private static ObjectNode inverseMass() {
        ObjectNode patch = JsonNodeFactory.instance.objectNode();
        patch.putObject("fluid").putObject("mass").put("gradient", "inverse-mass-linear");
        return patch;
    }
}
