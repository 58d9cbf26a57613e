package io.natator.run;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.body.Swimmer;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.SwimSample;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Scheme;
import io.natator.config.SimulatorMode;
import io.natator.process.Evaluator;
import io.natator.process.ProgramInfo;
import io.natator.protocol.SimulationResult;
import java.util.List;

/** Runs a swimmer under the conditions of {@link Controls}, all but the share under water. */
public final class ControlRuns {

    /** The largest number that a particle's acceleration can be: no clamp. */
    private static final double NO_CLAMP = 3.4028234663852886e38;

    private final EvolutionSettings settings;
    private final ExecutionSettings execution;
    private final int starts;
    private final WinnerRuns again;

    /**
     * For the winner of a run.
     *
     * @param execution with a time limit
     * @param starts    runs under each condition, at least 2
     */
    public ControlRuns(EvolutionSettings settings, ExecutionSettings execution, int starts)
            throws InterruptedException {
        this.settings = settings;
        this.execution = execution;
        this.starts = starts;
        this.again = new WinnerRuns(settings, execution.simulator());
    }

    /** The controls of a swimmer. */
    public Controls of(Swimmer swimmer) throws InterruptedException {
        try (Evaluator evaluator = EvolutionRun.open(execution)) {
            List<SimulationResult> inWater = evaluator.evaluate(again.requests(swimmer, starts, null));
            String scheme = inWater.stream().map(SimulationResult::scheme).filter(one -> one != null).findFirst()
                    .orElse("");
            SwimSample water = again.sample(inWater, swimmer, 1);
            SwimSample resting = sample(evaluator, swimmer.withGait(swimmer.gait().resting()), stopping());
            SwimSample vacuum = again.sample(evaluator.evaluate(again.requests(swimmer, starts, null).stream()
                    .map(request -> request.inVacuum(settings.problem().duration())).toList()), swimmer, 1);
            SwimSample clampOff = Scheme.of(scheme) == Scheme.FLEX ? sample(evaluator, swimmer, withoutClamp()) : null;
            SwimSample half = again.sample(evaluator.evaluate(again.requests(swimmer, starts, again.halfStep())),
                    swimmer, 2);
            SwimSample mirrored = sample(evaluator, swimmer.withGait(swimmer.gait().mirrored()), null);
            Backend other = otherBackend();
            return new Controls(swimmer.gait(), swimmer.body(), scheme, again.duration(), again.bodyLength(swimmer),
                    water, resting, vacuum, clampOff, half, mirrored, other == null ? null : onOther(swimmer, other),
                    other == null ? null : other.argument(), null);
        }
    }

    /** Runs from the same starts with a change of the scene, or null. */
    private SwimSample sample(Evaluator evaluator, Swimmer swimmer, ObjectNode change) throws InterruptedException {
        return again.sample(evaluator.evaluate(again.requests(swimmer, starts, change)), swimmer, 1);
    }

    /** Runs from the same starts on another backend. */
    private SwimSample onOther(Swimmer swimmer, Backend backend) throws InterruptedException {
        ExecutionSettings elsewhere = execution.withCommands(List.of()).withBackend(backend)
                .withMode(backend == Backend.CUDA ? SimulatorMode.BATCH : SimulatorMode.RESIDENT);
        try (Evaluator evaluator = EvolutionRun.open(elsewhere)) {
            return sample(evaluator, swimmer, null);
        }
    }

    /** Null without a GPU. */
    private Backend otherBackend() throws InterruptedException {
        if (ProgramInfo.of(execution.simulator()).devices().isEmpty()) {
            return null;
        }
        return execution.backend() == Backend.CPU ? Backend.CUDA : Backend.CPU;
    }

    private static ObjectNode withoutClamp() {
        ObjectNode patch = JsonNodeFactory.instance.objectNode();
        patch.putObject("solver").put("maxAcceleration", NO_CLAMP);
        return patch;
    }

    /** A body at rest makes no progress, which is to end no run of it. */
    private static ObjectNode stopping() {
        ObjectNode patch = JsonNodeFactory.instance.objectNode();
        patch.putObject("stopping").put("noProgressAfter", 0);
        return patch;
    }
}
