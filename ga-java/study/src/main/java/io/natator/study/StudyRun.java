package io.natator.study;

import io.natator.simulator.Perturbation;
import io.natator.simulator.SimulationRequest;

/**
 * One evaluation of a study.
 *
 * @param seed of the random shift that makes equal runs differ, as they do in Flex by themselves; 0 for none: the start as
 *             it is stated, which is Flex' as well, with the symmetries that a shift breaks
 */
record StudyRun(Variant variant, Interval interval, int seed) {

    /** Largest shift of a starting coordinate, in scene units: invisible, but enough to part the runs in a second. */
    private static final double SHIFT = 1e-6;

    SimulationRequest request(long id) {
        return new SimulationRequest(id, variant.scene(), variant.gait(), interval.duration(), null,
                variant.overrides(), seed == 0 ? null : new Perturbation(SHIFT, seed));
    }
}
