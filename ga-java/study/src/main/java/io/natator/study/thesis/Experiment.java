package io.natator.study.thesis;

import io.natator.config.Scheme;
import io.natator.encoding.Gait;
import io.natator.simulator.Perturbation;
import io.natator.simulator.SimulationRequest;

/**
 * Something that is measured, in several runs whose starts differ by an invisible random shift.
 *
 * @param group   which of the thesis' questions it belongs to
 * @param subject what swims: a published gait {@code thesis/NAME}, or a run folder
 * @param setting what is special about the scene, or the value of a parameter
 * @param request the evaluation, without a shift
 */
record Experiment(String group, String subject, String setting, SimulationRequest request) {

    /** Largest shift of a starting coordinate, in scene units: invisible, but enough to part the runs in a second. */
    private static final double SHIFT = 1e-6;

    Scheme scheme() {
        return request.scheme();
    }

    Gait gait() {
        return request.gait();
    }

    /** One of the runs, with a seed from 1. */
    SimulationRequest run(int seed) {
        return new SimulationRequest(0, request.scene(), request.gait(), request.duration(), request.scheme(),
                request.overrides(), new Perturbation(SHIFT, seed));
    }
}
