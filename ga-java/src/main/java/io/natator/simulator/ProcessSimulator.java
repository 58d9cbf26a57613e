package io.natator.simulator;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import java.util.List;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * One native process per evaluation, as in the thesis (2.6): one JSON request on standard input, one JSON line on
 * standard output. A process that crashes, hangs or answers nonsense is tried once more; if that fails too, the
 * evaluation is recorded as failed and nothing else suffers.
 */
public final class ProcessSimulator implements Simulator {

    private static final Logger LOG = LoggerFactory.getLogger(ProcessSimulator.class);
    private static final int ATTEMPTS = 2;
    private static final int EXIT_OK = 0;
    private static final int EXIT_BAD_INPUT = 2;
    private static final int EXIT_UNSTABLE = 3;
    private static final int SHOWN_CHARACTERS = 80;

    private final NativeProgram program;

    /** A simulator that starts the given program for every evaluation. */
    public ProcessSimulator(ExecutionSettings settings) {
        this.program = new NativeProgram(settings.simulator(), settings.timeout());
    }

    @Override
    public SimulationResult evaluate(SimulationRequest request) throws InterruptedException {
        String input = Json.line(request) + "\n";
        String reason = "";
        for (int attempt = 1; attempt <= ATTEMPTS; attempt++) {
            try {
                return answer(request, program.call(List.of("evaluate"), input));
            } catch (SimulatorFailure e) {
                reason = e.getMessage();
                LOG.warn("evaluation {}, attempt {} of {}: {}", request.id(), attempt, ATTEMPTS, reason);
            }
        }
        return SimulationResult.failed(request.id(), reason);
    }

    private static SimulationResult answer(SimulationRequest request, NativeProgram.Output output)
            throws SimulatorFailure {
        SimulationResult result;
        try {
            result = Json.parse(output.text(), SimulationResult.class);
        } catch (JsonProcessingException e) {
            throw new SimulatorFailure("no valid result: " + Json.reason(e) + in(output), e);
        }
        if (result.status() == SimulationResult.Status.ERROR && result.error() != null && output.exitStatus() != 0) {
            throw new RequestRejectedException(result.error(), output.exitStatus() == EXIT_BAD_INPUT);
        }
        String fault = faultOf(request, result, output.exitStatus());
        if (fault != null) {
            throw new SimulatorFailure("no valid result: " + fault + in(output));
        }
        return result;
    }

    /** What contradicts the protocol in an answer, or null. */
    private static String faultOf(SimulationRequest request, SimulationResult result, int exitStatus) {
        if (result.id() == null || result.id() != request.id()) {
            return "id is " + result.id() + ", not " + request.id();
        }
        if (result.status() == SimulationResult.Status.OK) {
            return exitStatus != EXIT_OK ? "status ok with exit status " + exitStatus
                    : result.distance() == null || !Double.isFinite(result.distance()) ? "no finite distance"
                    : result.simulated() == null || !(result.simulated() >= 0) ? "no simulated time"
                    : null;
        }
        if (result.status() == SimulationResult.Status.UNSTABLE) {
            return exitStatus != EXIT_UNSTABLE ? "status unstable with exit status " + exitStatus : null;
        }
        return "status " + result.status() + " with exit status " + exitStatus;
    }

    private static String in(NativeProgram.Output output) {
        String shown = output.text().strip();
        shown = shown.length() <= SHOWN_CHARACTERS ? shown : shown.substring(0, SHOWN_CHARACTERS) + "…";
        return "; exit status " + output.exitStatus() + ", output \"" + shown.replaceAll("\\R", " | ") + "\""
                + (output.errorText().isEmpty() ? "" : ", errors \"" + output.errorText() + "\"");
    }

    @Override
    public void close() {
        program.close();
    }
}
