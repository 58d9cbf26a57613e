package io.natator.study.thesis;

import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.simulator.Evaluator;
import io.natator.simulator.Sha256;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import io.natator.study.KeyedLog;
import io.natator.study.Sample;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.stream.IntStream;

/**
 * The measured evaluations of the study, {@code measurements.jsonl}. What was measured once stays, whatever program and
 * backend it was measured with, which each row names; delete the file to measure anew.
 */
final class MeasurementLog implements AutoCloseable {

    private final KeyedLog<Measurement> rows;
    private final int runs;

    /**
     * Those of a study.
     *
     * @param runs of every experiment, at least 1
     */
    MeasurementLog(Path directory, int runs) {
        this.runs = runs;
        this.rows = new KeyedLog<>(directory.resolve("measurements.jsonl"), Measurement.class,
                row -> key(row.request()));
    }

    private static String key(SimulationRequest request) {
        return Json.line(request.withId(0));
    }

    /** The runs of these experiments that are not measured yet, each once. */
    List<SimulationRequest> missing(List<Experiment> experiments) {
        return experiments.stream().flatMap(one -> IntStream.rangeClosed(1, runs).mapToObj(one::run))
                .filter(request -> rows.find(key(request)) == null).distinct().toList();
    }

    /**
     * Measures what is missing.
     *
     * @param done called after each
     * @throws InterruptedException if the evaluator is closed; what is finished is kept
     */
    void measure(List<Experiment> experiments, Evaluator evaluator, ExecutionSettings execution, Runnable done)
            throws InterruptedException {
        List<SimulationRequest> missing = missing(experiments);
        List<SimulationRequest> numbered = new ArrayList<>();
        missing.forEach(request -> numbered.add(request.withId(numbered.size())));
        String program = Sha256.of(execution.simulator());
        evaluator.evaluateAll(numbered, result -> {
            if (result.status() != SimulationResult.Status.FAILED) {
                rows.add(new Measurement(program, execution.backend(),
                        missing.get(result.id().intValue()), result.withId(0)));
            }
            done.run();
        });
    }

    /** What came of the runs that are measured. */
    List<SimulationResult> results(Experiment experiment) {
        return IntStream.rangeClosed(1, runs).mapToObj(seed -> rows.find(key(experiment.run(seed))))
                .filter(Objects::nonNull).map(Measurement::result).toList();
    }

    /** Speeds of the runs that stayed stable, in scene units per second. */
    Sample speed(Experiment experiment) {
        return Sample.of(results(experiment).stream().filter(one -> one.status() == SimulationResult.Status.OK)
                .map(SimulationResult::speed).toList());
    }

    /** How many runs became unstable. */
    long unstable(Experiment experiment) {
        return results(experiment).stream().filter(one -> one.status() == SimulationResult.Status.UNSTABLE).count();
    }

    /** Digests of the programs that measured, with what they computed on, each once. */
    List<String> programs() {
        return rows.rows().stream().map(row -> row.program().substring(0, 12) + "… on " + row.backend().argument())
                .distinct().toList();
    }

    int size() {
        return rows.rows().size();
    }

    @Override
    public void close() {
        rows.close();
    }
}
