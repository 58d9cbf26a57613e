package io.natator.run;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.MergePatch;
import io.natator.body.Swimmer;
import io.natator.checkpoint.SwimSample;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.evolution.Seeds;
import io.natator.process.SceneInfo;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.IntStream;

/** Asks for a gait in a run's scene from starts that no generation had, and sums up what comes of it. */
final class WinnerRuns {

    private final EvolutionSettings settings;
    private final SceneInfo scene;
    private final double duration;

    /**
     * For the gaits of one run.
     *
     * @param simulator the native program
     */
    WinnerRuns(EvolutionSettings settings, Path simulator) throws InterruptedException {
        this.settings = settings;
        ObjectNode scheme = JsonNodeFactory.instance.objectNode();
        if (settings.problem().scheme() != null) {
            scheme.put("scheme", Json.name(settings.problem().scheme()));
        }
        this.scene = SceneInfo.of(settings.problem().scene(), MergePatch.both(settings.problem().overrides(), scheme),
                simulator);
        this.duration = scene.end(settings.problem().duration());
    }

    /** Simulated time of a run that nothing ends early, in seconds. */
    double duration() {
        return duration;
    }

    /** Length of a swimmer in scene units, or null if it is unknown. */
    Double bodyLength(Swimmer swimmer) {
        return swimmer.body() == null ? scene.bodyLength()
                : Double.valueOf(settings.problem().bodyLength(swimmer.body()));
    }

    /** What half the time step changes in the scene. */
    ObjectNode halfStep() {
        ObjectNode change = JsonNodeFactory.instance.objectNode();
        change.putObject("solver").put("substeps", 2 * scene.substeps());
        return change;
    }

    /**
     * From so many starts.
     *
     * @param change to the run's scene, or null
     */
    List<SimulationRequest> requests(Swimmer swimmer, int starts, ObjectNode change) {
        return IntStream.range(0, starts).mapToObj(k -> SimulationRequest.of(k, settings, swimmer).withChange(change)
                .withStart(Seeds.freshStart(settings.search().seed(), k))).toList();
    }

    /**
     * Sums up runs of such requests.
     *
     * @param finer 2 at half the time step, else 1
     */
    SwimSample sample(List<SimulationResult> results, Swimmer swimmer, int finer) {
        return SwimSample.of(results, finer * scene.substeps(), swimmer.gait(), duration, bodyLength(swimmer));
    }
}
