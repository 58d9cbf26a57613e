package io.natator.run;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.SwimSample;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.config.MergePatch;
import io.natator.config.SimulatorMode;
import io.natator.encoding.Gait;
import io.natator.evolution.Starts;
import io.natator.simulator.Evaluator;
import io.natator.simulator.ProgramInfo;
import io.natator.simulator.SceneInfo;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import io.natator.simulator.VacuumRequests;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.IntStream;

/** Runs a gait under the conditions of {@link Controls}, all but the share under water. */
public final class ControlRuns {

    /** The largest number that a particle's acceleration can be: no clamp. */
    private static final double NO_CLAMP = 3.4028234663852886e38;
    private static final String FLEX = "flex";

    private final EvolutionSettings settings;
    private final ExecutionSettings execution;
    private final int starts;
    private final SceneInfo scene;
    private final double duration;

    /**
     * For the winner of a run.
     *
     * @param execution with a time limit
     * @param starts    runs under each condition, at least 2
     */
    public ControlRuns(EvolutionSettings settings, ExecutionSettings execution, int starts) throws InterruptedException {
        this.settings = settings;
        this.execution = execution;
        this.starts = starts;
        this.scene = SceneInfo.of(settings.scene(), MergePatch.both(settings.overrides(), scheme()), execution.simulator());
        this.duration = settings.duration() != null ? settings.duration() : scene.duration();
    }

    private JsonNode scheme() {
        ObjectNode patch = JsonNodeFactory.instance.objectNode();
        return settings.scheme() == null ? patch : patch.put("scheme", Json.line(settings.scheme()).replace("\"", ""));
    }

    /** The controls of a gait. */
    public Controls of(Gait gait) throws InterruptedException {
        try (Evaluator evaluator = EvolutionRun.open(execution)) {
            List<SimulationResult> inWater = runs(requests(gait, null), evaluator);
            String scheme = inWater.stream().map(SimulationResult::scheme).filter(one -> one != null).findFirst().orElse("");
            SwimSample water = sample(inWater, gait, 1);
            // A body at rest makes no progress, which is to end no run of it.
            SwimSample resting = sample(runs(requests(gait.resting(), stopping()), evaluator), gait, 1);
            SwimSample vacuum = sample(runs(requests(gait, null).stream()
                    .map(request -> VacuumRequests.of(request, settings.duration())).toList(), evaluator), gait, 1);
            SwimSample clampOff = scheme.equals(FLEX)
                    ? sample(runs(requests(gait, solver("maxAcceleration", NO_CLAMP)), evaluator), gait, 1) : null;
            SwimSample half = sample(runs(requests(gait, solver("substeps", 2 * scene.substeps())), evaluator), gait, 2);
            SwimSample mirrored = sample(runs(requests(gait.mirrored(), null), evaluator), gait, 1);
            Backend other = otherBackend();
            return new Controls(gait, scheme, duration, scene.bodyLength(), water, resting, vacuum, clampOff, half, mirrored,
                    other == null ? null : onOther(gait, other), other == null ? null : other.argument(), null);
        }
    }

    /** The same runs on another backend. */
    private SwimSample onOther(Gait gait, Backend backend) throws InterruptedException {
        ExecutionSettings elsewhere = execution.withBackend(backend)
                .withMode(backend == Backend.CUDA ? SimulatorMode.BATCH : SimulatorMode.RESIDENT);
        try (Evaluator evaluator = EvolutionRun.open(elsewhere)) {
            return sample(runs(requests(gait, null), evaluator), gait, 1);
        }
    }

    /** Null without a GPU. */
    private Backend otherBackend() throws InterruptedException {
        if (ProgramInfo.of(execution.simulator()).devices().isEmpty()) {
            return null;
        }
        return execution.backend() == Backend.CPU ? Backend.CUDA : Backend.CPU;
    }

    private static ObjectNode solver(String name, double value) {
        ObjectNode patch = JsonNodeFactory.instance.objectNode();
        ObjectNode solver = patch.putObject("solver");
        if (value == Math.rint(value) && value < Integer.MAX_VALUE) {
            solver.put(name, (int) value);
        } else {
            solver.put(name, value);
        }
        return patch;
    }

    private static ObjectNode stopping() {
        ObjectNode patch = JsonNodeFactory.instance.objectNode();
        patch.putObject("stopping").put("noProgressAfter", 0);
        return patch;
    }

    private List<SimulationRequest> requests(Gait gait, ObjectNode change) {
        return IntStream.range(0, starts).mapToObj(k -> new SimulationRequest(k, settings.scene(), gait,
                settings.duration(), settings.scheme(), MergePatch.both(settings.overrides(), change))
                .withStart(Starts.fresh(settings.seed(), k))).toList();
    }

    private static List<SimulationResult> runs(List<SimulationRequest> requests, Evaluator evaluator)
            throws InterruptedException {
        List<SimulationResult> results = new ArrayList<>();
        evaluator.evaluateInOrder(requests, results::add);
        return results;
    }

    private SwimSample sample(List<SimulationResult> results, Gait gait, int finer) {
        return SwimSample.of(results, finer * scene.substeps(), gait, duration, scene.bodyLength());
    }
}
