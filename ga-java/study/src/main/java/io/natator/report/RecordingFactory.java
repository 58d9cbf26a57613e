package io.natator.report;

import io.natator.config.ExecutionSettings;
import io.natator.flow.FlowField;
import io.natator.flow.SlicePlane;
import io.natator.flow.Snapshot;
import io.natator.kinematics.BodyPath;
import io.natator.simulator.Sha256;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.TrajectoryRecorder;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;

/** Makes recordings of runs. */
public final class RecordingFactory {

    private RecordingFactory() {
    }

    /**
     * Runs a request once on the processor.
     *
     * @param request   that does not end early
     * @param at        when to look at the fluid, in seconds
     * @param execution with a time limit
     * @throws InterruptedException if the calling thread is interrupted
     */
    public static Recording of(SimulationRequest request, double at, ExecutionSettings execution)
            throws InterruptedException {
        Path folder = null;
        try {
            folder = Files.createTempDirectory("natator-");
            Path path = folder.resolve("path.csv");
            Path particles = folder.resolve("particles.csv");
            new TrajectoryRecorder(execution).record(request, path, particles, at);
            Snapshot snapshot = Files.exists(particles) ? Snapshot.read(particles) : null;
            List<FlowField> flow = snapshot == null || snapshot.fluid().isEmpty() ? List.of()
                    : Arrays.stream(SlicePlane.values()).map(view -> FlowField.of(snapshot, view)).toList();
            return Recording.of(Sha256.of(execution.simulator()), request, BodyPath.read(path), flow);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot record a run: " + e.getMessage(), e);
        } finally {
            remove(folder);
        }
    }

    private static void remove(Path folder) {
        if (folder != null) {
            for (String name : List.of("path.csv", "particles.csv", ".")) {
                folder.resolve(name).normalize().toFile().delete();
            }
        }
    }
}
