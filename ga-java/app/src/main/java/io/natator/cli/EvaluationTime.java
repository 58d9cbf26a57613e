package io.natator.cli;

import io.natator.body.Swimmer;
import io.natator.config.EvolutionSettings;
import io.natator.evolution.EvolutionFailedException;
import io.natator.process.Evaluator;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.List;
import java.util.stream.LongStream;

/**
 * How long evaluations take, judged by a few short ones of the swimmer in the middle of all ranges.
 *
 * @param evaluator stays the caller's
 */
record EvaluationTime(EvolutionSettings settings, Evaluator evaluator) {

    /** Simulated seconds of the trials, at most; their difference leaves out what every evaluation costs once. */
    private static final double SHORT_TRIAL = 0.05;
    private static final double LONG_TRIAL = 0.25;
    private static final double NANOSECONDS = 1e9;

    /**
     * Seconds that evaluations take together. No trial is longer than they are, so that what is too short is refused here.
     *
     * @param together how many, at least 1
     * @param duration simulated seconds of each
     * @throws EvolutionFailedException if a trial fails
     */
    double of(int together, double duration) throws InterruptedException {
        double trial = Math.min(SHORT_TRIAL, duration);
        seconds(1, trial);
        double small = seconds(together, trial);
        if (duration <= SHORT_TRIAL) {
            return small;
        }
        double large = seconds(together, LONG_TRIAL);
        double perSecond = Math.max(large - small, 0) / (LONG_TRIAL - SHORT_TRIAL);
        return small + (duration - SHORT_TRIAL) * perSecond;
    }

    private double seconds(int count, double duration) throws InterruptedException {
        Swimmer middle = settings.problem().genome().middle();
        List<SimulationRequest> requests = LongStream.range(0, count)
                .mapToObj(id -> SimulationRequest.of(id, settings, middle).withDuration(duration)).toList();
        long start = System.nanoTime();
        evaluator.evaluateAll(requests, result -> {
            if (result.status() == SimulationResult.Status.FAILED) {
                throw new EvolutionFailedException("a trial evaluation failed: " + result.error());
            }
        });
        return (System.nanoTime() - start) / NANOSECONDS;
    }
}
