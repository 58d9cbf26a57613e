package io.natator.study.thesis;

import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.simulator.Evaluator;
import io.natator.simulator.ProgramInfo;
import io.natator.simulator.Sha256;
import io.natator.simulator.SimulationRequest;
import io.natator.study.KeyedLog;
import java.nio.file.Path;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

/** Times of the parameter study, {@code costs.jsonl}, by the clock: one evaluation at a time, on the processor. */
final class TimingLog implements AutoCloseable {

    private static final double LONGEST = 0.5;
    private static final int TRIALS = 3;
    private static final double NANOSECONDS = 1e9;

    private final KeyedLog<Timing> rows;

    TimingLog(Path directory) {
        rows = new KeyedLog<>(directory.resolve("costs.jsonl"), Timing.class, row -> key(row.request()));
    }

    private static String key(SimulationRequest request) {
        return Json.line(timed(request));
    }

    /** The part that is timed: the beginning. */
    private static SimulationRequest timed(SimulationRequest request) {
        double duration = request.duration() == null ? LONGEST : Math.min(LONGEST, request.duration());
        return new SimulationRequest(0, request.scene(), request.gait(), duration, request.scheme(),
                request.overrides());
    }

    /** Those that are not timed yet, each once. */
    List<Experiment> missing(List<Experiment> experiments) {
        Set<String> seen = new HashSet<>();
        return experiments.stream().filter(one -> rows.find(key(one.request())) == null && seen.add(key(one.request())))
                .toList();
    }

    /** Seconds per simulated second, or NaN. */
    double of(Experiment experiment) {
        Timing found = rows.find(key(experiment.request()));
        return found == null ? Double.NaN : found.seconds();
    }

    /** What they were timed on, each once. */
    List<String> machines() {
        return rows.rows().stream().map(Timing::machine).distinct().toList();
    }

    /**
     * Times what is missing.
     *
     * @throws InterruptedException if the calling thread is interrupted; what is finished is kept
     */
    void time(List<Experiment> experiments, ExecutionSettings execution, Runnable done) throws InterruptedException {
        List<Experiment> missing = missing(experiments);
        if (missing.isEmpty()) {
            return;
        }
        String program = Sha256.of(execution.simulator());
        String machine = System.getProperty("os.arch") + ", " + ProgramInfo.of(execution.simulator()).instructionSet();
        ExecutionSettings alone = ExecutionSettings.of(execution.simulator()).withWorkers(1).withTimeout(execution.timeout());
        try (Evaluator evaluator = Evaluator.open(alone)) {
            for (Experiment experiment : missing) {
                SimulationRequest request = timed(experiment.request());
                double least = Double.POSITIVE_INFINITY;
                double simulated = 0;
                for (int trial = 0; trial < TRIALS; trial++) {
                    long start = System.nanoTime();
                    Double reached = evaluator.evaluate(request).simulated();
                    least = Math.min(least, (System.nanoTime() - start) / NANOSECONDS);
                    simulated = reached == null ? 0 : reached;
                }
                rows.add(new Timing(program, machine, request, simulated > 0 ? least / simulated : 0));
                done.run();
            }
        }
    }

    @Override
    public void close() {
        rows.close();
    }
}
