package io.natator.process;

import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.protocol.RefusedSceneException;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulatorFailure;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/** Runs a request once on the processor, with the paths of all body particles, and all particles at one moment. */
public final class TrajectoryRecorder {

    /** Exit status of a run that became unstable. */
    private static final int UNSTABLE = 3;

    private final ExecutionSettings execution;

    /** A recorder that uses the execution's program and time limit. */
    public TrajectoryRecorder(ExecutionSettings execution) {
        this.execution = execution;
    }

    /**
     * Runs {@code natator-sim run}.
     *
     * @param trajectory where the paths go, or null
     * @param snapshot   where all particles go, or null
     * @param at         the moment of the snapshot, in seconds, or null for the end of the run
     * @return whether the run stayed stable; if not, the paths end before that
     * @throws RefusedSceneException    if the program refuses the request
     * @throws RequestRejectedException if it fails
     * @throws InterruptedException     if the calling thread is interrupted
     */
    public boolean record(SimulationRequest request, Path trajectory, Path snapshot, Double at)
            throws InterruptedException {
        List<String> arguments = new ArrayList<>(List.of("run", request.scene()));
        add(arguments, "--gait", request.gait() == null ? null : Json.line(request.gait()));
        add(arguments, "--duration", request.duration());
        add(arguments, "--scheme", request.scheme() == null ? null : request.scheme().name().toLowerCase(Locale.ROOT));
        add(arguments, "--overrides", request.overrides());
        if (request.perturbation() != null) {
            add(arguments, "--perturbation", request.perturbation().amplitude());
            add(arguments, "--perturbation-seed", request.perturbation().seed());
        }
        if (trajectory != null) {
            add(arguments, "--trajectory", trajectory);
            arguments.add("--particles");
        }
        if (snapshot != null) {
            add(arguments, "--snapshot", snapshot);
            add(arguments, "--at", at);
        }
        try (NativeProgram program = new NativeProgram(execution.simulator(), execution.timeout())) {
            NativeProgram.Output output = program.call(arguments, "", line -> { });
            if (output.exitStatus() != 0 && output.exitStatus() != UNSTABLE) {
                throw output.failure("scene " + request.scene());
            }
            return output.exitStatus() == 0;
        } catch (SimulatorFailure e) {
            throw new RequestRejectedException("scene " + request.scene() + " cannot be recorded: " + e.getMessage(), false);
        }
    }

    private static void add(List<String> arguments, String option, Object value) {
        if (value != null) {
            arguments.add(option);
            arguments.add(value.toString());
        }
    }
}
