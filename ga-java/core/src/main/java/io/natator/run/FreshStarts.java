package io.natator.run;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.checkpoint.FreshRuns;
import io.natator.checkpoint.SwimSample;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.config.MergePatch;
import io.natator.encoding.Gait;
import io.natator.evolution.Individual;
import io.natator.evolution.Starts;
import io.natator.simulator.Evaluator;
import io.natator.simulator.RequestRejectedException;
import io.natator.simulator.SceneInfo;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.IntStream;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Runs a winner from starts that no generation had, as the run simulates and at half the time step. */
final class FreshStarts {

    private static final Logger LOG = LoggerFactory.getLogger(FreshStarts.class);
    /** Runs at each time step: twice those that a newborn has, and enough for a standard deviation. */
    private static final int LEAST = 4;

    private final EvolutionSettings settings;
    private final Evaluator evaluator;
    private final SceneInfo scene;
    private final double duration;

    /**
     * For the winner of one run.
     *
     * @param evaluator as in the run: what it measures is judged as there
     * @param simulator the native program
     */
    FreshStarts(EvolutionSettings settings, Evaluator evaluator, Path simulator) throws InterruptedException {
        this.settings = settings;
        this.evaluator = evaluator;
        this.scene = SceneInfo.of(settings.scene(), MergePatch.both(settings.overrides(), scheme(settings)), simulator);
        this.duration = settings.duration() != null ? settings.duration() : scene.duration();
    }

    private static JsonNode scheme(EvolutionSettings settings) {
        ObjectNode patch = JsonNodeFactory.instance.objectNode();
        return settings.scheme() == null ? patch : patch.put("scheme", Json.line(settings.scheme()).replace("\"", ""));
    }

    /** The winner again, or null if the simulator refuses that. */
    FreshRuns of(Individual winner) throws InterruptedException {
        Gait gait = gait(winner);
        List<SimulationResult> base = runs(gait, settings.overrides());
        if (base == null) {
            return null;
        }
        ObjectNode finer = JsonNodeFactory.instance.objectNode();
        finer.putObject("solver").put("substeps", 2 * scene.substeps());
        List<SimulationResult> half = runs(gait, MergePatch.both(settings.overrides(), finer));
        return FreshRuns.of(duration, sample(base, scene.substeps(), gait),
                half == null ? null : sample(half, 2 * scene.substeps(), gait), settings.judge(), winner.score(),
                winner.runs(), settings.judge().of(base.stream().map(SimulationResult::score).toList()));
    }

    /** From the fresh starts; null, and a word of it, if the simulator refuses them. What the run found is not lost by that. */
    private List<SimulationResult> runs(Gait gait, JsonNode overrides) throws InterruptedException {
        int starts = Math.max(LEAST, 2 * settings.starts());
        List<SimulationRequest> requests = IntStream.range(0, starts).mapToObj(k -> new SimulationRequest(k,
                settings.scene(), gait, settings.duration(), settings.scheme(), overrides)
                .withStart(Starts.fresh(settings.seed(), k))).toList();
        List<SimulationResult> results = new ArrayList<>();
        try {
            evaluator.evaluateInOrder(requests, results::add);
        } catch (RequestRejectedException e) {
            LOG.warn("the winner is not run from fresh starts: {}", e.getMessage());
            return null;
        }
        return results;
    }

    private SwimSample sample(List<SimulationResult> results, int substeps, Gait gait) {
        return SwimSample.of(results, substeps, gait, duration, scene.bodyLength());
    }

    /** The winner from the scene's own start, as whoever watches it sees it. */
    SimulationResult fromOwnStart(Individual winner) throws InterruptedException {
        return evaluator.evaluate(new SimulationRequest(winner.result().id(), settings.scene(), gait(winner),
                settings.duration(), settings.scheme(), settings.overrides()));
    }

    private Gait gait(Individual winner) {
        return settings.encoding().forActuators(settings.actuators()).decode(winner.genes());
    }
}
