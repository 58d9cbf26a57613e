package io.natator.process;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.protocol.FinerLevel;
import io.natator.protocol.RefusedSceneException;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulatorFailure;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import java.util.stream.Collectors;

/** Asks {@code natator-sim converge} how far a swim depends on the sizes of its steps. */
public final class ConvergeProgram {

    /** Half the spacing takes eight times as many particles. */
    private static final int TIMES_AS_LONG = 16;
    private static final String PROGRESS = NativeProgram.Output.NAME + NativeProgram.Output.PROGRESS;

    private final ExecutionSettings execution;

    /**
     * The program of an execution.
     *
     * @param execution with a time limit for one evaluation; each run has as many threads as it has workers
     */
    public ConvergeProgram(ExecutionSettings execution) {
        this.execution = execution;
    }

    /**
     * Runs a swim as it is asked for and at finer levels, all from the same starts.
     *
     * @param starts how many, at least 2
     * @param levels beside its own, each once
     * @param runs   gets a line for each run; those that it has already are not done again
     * @param ran    told, in another thread, of each run that has ended: which, and how far it came
     * @param table  told likewise, at the end, the lines of the table for people
     * @return what the program says, see sim-native/protocol/converge.md
     * @throws RefusedSceneException    if the program refuses that
     * @throws RequestRejectedException if it fails
     */
    public JsonNode of(SimulationRequest request, int starts, List<FinerLevel> levels, Path runs,
            Consumer<String> ran, Consumer<String> table) throws InterruptedException {
        Consumer<String> lines = line -> {
            if (line.startsWith(PROGRESS)) {
                ran.accept(line.substring(PROGRESS.length()));
            } else if (!line.startsWith(NativeProgram.Output.NAME)) {
                table.accept(line);
            }
        };
        List<String> arguments = new ArrayList<>(List.of("converge", Json.line(request), "--starts", "" + starts,
                "--levels", levels.stream().map(FinerLevel::label).collect(Collectors.joining(",")), "--backend",
                execution.backend().argument(), "--output", runs.toString()));
        arguments.addAll(execution.backend() == Backend.CPU ? List.of("--threads", "" + execution.workers())
                : List.of("--device", "" + execution.device()));
        Duration limit = execution.timeout().multipliedBy((long) TIMES_AS_LONG * starts * (1 + levels.size()));
        String subject = "scene " + request.scene() + " at other levels";
        try (NativeProgram program = new NativeProgram(execution.simulator(), limit)) {
            NativeProgram.Output output = program.call(arguments, "", lines);
            if (output.exitStatus() != ExitStatus.OK && output.exitStatus() != ExitStatus.UNSTABLE) {
                throw output.failure(subject);
            }
            return Json.parse(output.text(), JsonNode.class);
        } catch (SimulatorFailure | JsonProcessingException e) {
            throw new RequestRejectedException(subject + ": " + e.getMessage(), false);
        }
    }
}
