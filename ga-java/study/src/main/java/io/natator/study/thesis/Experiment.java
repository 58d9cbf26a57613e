package io.natator.study.thesis;

import io.natator.simulator.Perturbation;
import io.natator.simulator.SimulationRequest;
import java.util.List;
import java.util.stream.IntStream;

/**
 * Something that is measured, in several runs that begin from different starts.
 *
 * @param group   which of the thesis' questions it belongs to
 * @param subject what swims
 * @param setting what is special about the scene, or the value of a parameter
 * @param request the evaluation, from the scene's own start
 * @param first   number of the first start; those of different purposes differ
 * @param starts  how many
 */
record Experiment(String group, String subject, String setting, SimulationRequest request, int first, int starts) {

    /** Largest shift of a starting coordinate of what is recorded, in scene units: invisible, but runs part within a second. */
    private static final double SHIFT = 1e-6;

    /** Its runs. */
    List<SimulationRequest> runs() {
        return IntStream.range(first, first + starts).mapToObj(request::withStart).toList();
    }

    /**
     * Runs to be recorded, for their whole time; the recorder of paths takes a shift of the start, no number.
     *
     * @param count how many
     */
    List<SimulationRequest> recordings(int count) {
        SimulationRequest whole = request.withoutStops();
        return IntStream.rangeClosed(1, count).mapToObj(seed -> new SimulationRequest(0, whole.scene(), whole.gait(), whole.duration(),
                whole.scheme(), whole.overrides(), new Perturbation(SHIFT, seed))).toList();
    }
}
