package io.natator.study.thesis;

import io.natator.checkpoint.SwimSample;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.simulator.Evaluator;
import io.natator.simulator.Sha256;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import io.natator.study.Sample;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.function.IntConsumer;
import java.util.function.Supplier;
import java.util.function.ToDoubleFunction;
import java.util.stream.Stream;

/**
 * Measured evaluations of the study. What was measured once stays, whatever program and
 * backend it was measured with, which each row names; delete the file to measure anew.
 */
final class MeasurementLog extends RequestLog<Measurement> {

    /** Those of a file of JSON lines, which is made with the first. */
    MeasurementLog(Path file) {
        super(file, Measurement.class);
    }

    /** The runs of these experiments that are not measured yet, each once. */
    List<SimulationRequest> missing(List<Experiment> experiments) {
        return experiments.stream().flatMap(one -> one.runs().stream())
                .filter(request -> find(request) == null).distinct().toList();
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
                add(new Measurement(program, execution.backend(),
                        missing.get(result.id().intValue()), result.withId(0L)));
            }
            done.run();
        });
    }

    /**
     * Measures what is missing, then what that has made known, until a round has added nothing.
     *
     * @param experiments what is known by now
     * @param round       called before each round with its number of runs
     * @param done        called after each run
     * @throws InterruptedException if the evaluator is closed; what is finished is kept
     */
    void measureAll(Supplier<List<Experiment>> experiments, Evaluator evaluator, ExecutionSettings execution, IntConsumer round,
            Runnable done) throws InterruptedException {
        List<SimulationRequest> before = List.of();
        for (List<SimulationRequest> left = missing(experiments.get()); !left.isEmpty() && !left.equals(before);
                left = missing(experiments.get())) {
            round.accept(left.size());
            measure(experiments.get(), evaluator, execution, done);
            before = left;
        }
    }

    /** Whether all runs are measured. */
    boolean has(Experiment experiment) {
        return results(experiment).size() == experiment.starts();
    }

    /** What came of the runs that are measured. */
    List<SimulationResult> results(Experiment experiment) {
        return measured(experiment).map(Measurement::result).toList();
    }

    private Stream<Measurement> measured(Experiment experiment) {
        return experiment.runs().stream().map(request -> find(request)).filter(Objects::nonNull);
    }

    /** Ways along x of the runs that stayed stable by the whole time, whether they lasted so long or not; scene units per second. */
    Sample speed(Experiment experiment, double duration) {
        return sample(experiment, result -> result.distance() / duration);
    }

    /** Ways along x of the runs that stayed stable by the time that each of them lasted; scene units per second. */
    Sample speedWhileLasting(Experiment experiment) {
        return sample(experiment, SimulationResult::speed);
    }

    /** Speeds along the body's own heading while the runs lasted, scene units per second. */
    Sample forward(Experiment experiment) {
        return sample(experiment, result -> result.simulated() > 0
                ? (result.course() == null ? result.distance() : result.course().forward()) / result.simulated() : 0);
    }

    /** Seconds that the runs lasted which stayed stable. */
    Sample lasted(Experiment experiment) {
        return sample(experiment, SimulationResult::simulated);
    }

    private Sample sample(Experiment experiment, ToDoubleFunction<SimulationResult> value) {
        return Sample.of(results(experiment).stream().filter(one -> one.status() == SimulationResult.Status.OK)
                .map(value::applyAsDouble).toList());
    }

    /** All figures of the runs that are measured; null without any. */
    SwimSample swim(Experiment experiment, int substeps, double duration, Double bodyLength) {
        List<SimulationResult> results = results(experiment);
        return results.isEmpty() ? null : SwimSample.of(results, substeps, experiment.request().gait(), duration, bodyLength);
    }

    /** Whether any of the runs that are measured was on a GPU. */
    boolean isOnGpu(Experiment experiment) {
        return measured(experiment).anyMatch(row -> row.backend() != Backend.CPU);
    }

    /** How many runs became unstable. */
    long unstable(Experiment experiment) {
        return results(experiment).stream().filter(one -> one.status() == SimulationResult.Status.UNSTABLE).count();
    }

    /** Digests of the programs that measured, with what they computed on, each once. */
    List<String> programs() {
        return rows().stream().map(row -> row.program().substring(0, 12) + "… on " + row.backend().argument())
                .distinct().toList();
    }
}
