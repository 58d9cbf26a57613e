package io.natator.simulator;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import java.time.Duration;
import java.util.List;

/** Asks {@code natator-sim converge} how far a swim depends on the sizes of its steps. */
public final class ConvergeProgram {

    /** Half the spacing takes eight times as many particles. */
    private static final int TIMES_AS_LONG = 16;

    private final ExecutionSettings execution;

    /**
     * Of an execution.
     *
     * @param execution with a time limit for one evaluation
     */
    public ConvergeProgram(ExecutionSettings execution) {
        this.execution = execution;
    }

    /**
     * Runs a swim as it is asked for and at finer levels, all from the same starts.
     *
     * @param starts how many, at least 2
     * @param levels for example {@code spacing/2}
     * @return what the program says, see sim-native/docs/simulator.md
     * @throws RefusedSceneException    if the program refuses that
     * @throws RequestRejectedException if it fails
     * @throws InterruptedException     if the calling thread is interrupted
     */
    public JsonNode of(SimulationRequest request, int starts, List<String> levels) throws InterruptedException {
        List<String> arguments = List.of("converge", Json.line(request), "--starts", "" + starts, "--levels", String.join(",", levels),
                "--backend", execution.backend().argument());
        Duration limit = execution.timeout().multipliedBy((long) TIMES_AS_LONG * starts * (1 + levels.size()));
        String subject = "scene " + request.scene() + " at other levels";
        try (NativeProgram program = new NativeProgram(execution.simulator(), limit)) {
            NativeProgram.Output output = program.call(arguments, "");
            if (output.exitStatus() != 0) {
                throw output.failure(subject);
            }
            return Json.parse(output.text(), JsonNode.class);
        } catch (SimulatorFailure | JsonProcessingException e) {
            throw new RequestRejectedException(subject + ": " + e.getMessage(), false);
        }
    }
}
