package io.natator.study.thesis;

import io.natator.config.ExecutionSettings;
import io.natator.flow.Snapshot;
import io.natator.flow.WaterLevel;
import io.natator.kinematics.BodyPath;
import io.natator.simulator.Sha256;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.TrajectoryRecorder;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;

/** The recorded runs of the study, {@code motions.jsonl}: what was recorded and measured once stays. */
final class KinematicsLog extends RequestLog<SwimKinematics> {

    private final int runs;

    /**
     * Those of a study.
     *
     * @param runs of every experiment, at least 1
     */
    KinematicsLog(Path directory, int runs) {
        super(directory.resolve("motions.jsonl"), SwimKinematics.class);
        this.runs = runs;
    }

    /** The runs of these experiments that are not recorded yet, each once. */
    List<SimulationRequest> missing(List<Experiment> experiments) {
        return experiments.stream().flatMap(one -> one.recordings(runs).stream())
                .filter(request -> find(request) == null).distinct().toList();
    }

    /** What came of the runs that are recorded. */
    List<SwimKinematics> of(Experiment experiment) {
        return experiment.recordings(runs).stream().map(request -> find(request))
                .filter(Objects::nonNull).toList();
    }

    /**
     * Records and measures what is missing, as many at once as the execution has workers.
     *
     * @param done called after each
     * @throws InterruptedException if the calling thread is interrupted; what is finished is kept
     */
    void record(List<Experiment> experiments, ExecutionSettings execution, Runnable done)
            throws InterruptedException {
        String program = Sha256.of(execution.simulator());
        ExecutorService workers = Executors.newFixedThreadPool(execution.workers());
        try {
            List<Future<SwimKinematics>> recorded = new ArrayList<>();
            for (SimulationRequest request : missing(experiments)) {
                recorded.add(workers.submit(() -> record(program, request, execution)));
            }
            for (Future<SwimKinematics> motion : recorded) {
                add(motion.get());
                done.run();
            }
        } catch (ExecutionException e) {
            if (e.getCause() instanceof RuntimeException cause) {
                throw cause;
            }
            throw new IllegalStateException(e.getCause());
        } finally {
            workers.shutdownNow();
        }
    }

    private static SwimKinematics record(String program, SimulationRequest request, ExecutionSettings execution)
            throws InterruptedException {
        try {
            Path folder = Files.createTempDirectory("natator-");
            Path file = folder.resolve("path.csv");
            Path particles = folder.resolve("particles.csv");
            try {
                double duration = request.duration() == null ? StudyResults.THESIS_SECONDS : request.duration();
                new TrajectoryRecorder(execution).record(request, file, particles, duration / 2);
                return SwimKinematics.of(program, request, BodyPath.read(file),
                        Files.exists(particles) ? WaterLevel.shareBelow(Snapshot.read(particles)) : null);
            } finally {
                Files.deleteIfExists(file);
                Files.deleteIfExists(particles);
                Files.deleteIfExists(folder);
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot record a run: " + e.getMessage(), e);
        }
    }
}
