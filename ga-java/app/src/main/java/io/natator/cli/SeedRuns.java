package io.natator.cli;

import io.natator.base.Numbers;
import io.natator.checkpoint.RunWriter;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.Individual;
import io.natator.process.Evaluator;
import io.natator.run.EvolutionRun;
import io.natator.run.PlannedRun;
import io.natator.run.RunQueue;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.function.Supplier;
import java.util.stream.LongStream;

/** Evolutions that differ in their seeds, as far as they are not finished: tells of each, and every few seconds of all. */
final class SeedRuns implements RunQueue.Watcher {

    private static final double INTERVAL_SECONDS = 10;
    private static final double NANOSECONDS = 1e9;

    private final List<PlannedRun> runs;
    private final long evaluations;
    private final long before;
    private final PrintWriter err;
    private final long started = System.nanoTime();
    private long said = started;
    private long done;
    private Supplier<EvolutionListener> late = () -> new EvolutionListener() {
    };

    /**
     * From the settings' seed on.
     *
     * @param seeds     how many
     * @param directory of the run folders
     * @throws io.natator.base.InvalidInputException if there are runs of other settings in them
     */
    SeedRuns(EvolutionSettings settings, int seeds, Path directory, PrintWriter err) {
        this.runs = LongStream.range(settings.search().seed(), settings.search().seed() + seeds)
                .mapToObj(seed -> new PlannedRun(settings.withSeed(seed), directory.resolve("seed-" + seed))).toList();
        this.err = err;
        runs.forEach(PlannedRun::check);
        this.evaluations = seeds * ProgressEstimate.evaluations(settings);
        this.before = runs.stream().mapToLong(PlannedRun::recorded).sum();
    }

    /** How many have come to their end. */
    long finished() {
        return runs.stream().filter(PlannedRun::isFinished).count();
    }

    /**
     * Carries out what is missing; their generations share a batch.
     *
     * @param execution with a time limit
     * @param atOnce    runs under way at the same time
     * @param stopAfter seconds, or null
     */
    void run(ExecutionSettings execution, int atOnce, Double stopAfter) throws InterruptedException {
        RunQueue queue = new RunQueue(runs, execution.simulator());
        try (Evaluator evaluator = EvolutionRun.open(execution);
                ShutdownHandler shutdown = new ShutdownHandler(evaluator, stopAfter,
                        () -> say("interrupted; the same command continues"))) {
            if (execution.inBatches()) {
                late = shutdown::beforeLateGenerations;
            }
            queue.run(execution, evaluator, atOnce, this);
        }
    }

    @Override
    public EvolutionListener forRun() {
        return late.get();
    }

    @Override
    public synchronized void evaluated() {
        done++;
        long now = System.nanoTime();
        if ((now - said) / NANOSECONDS >= INTERVAL_SECONDS) {
            said = now;
            double rate = done / ((now - started) / NANOSECONDS);
            say(String.format(Locale.ROOT, "%d of %d evaluations, %.1f evaluations/s, left %s", before + done,
                    evaluations, rate,
                    ProgressEstimate.readable(Math.round(Math.max(evaluations - before - done, 0) / rate))));
        }
    }

    @Override
    public synchronized void finished(RunWriter run, EvolutionRun.Outcome outcome) {
        Individual best = outcome.state().best();
        say(run.directory() + "  best " + Numbers.fixed(best == null ? 0 : best.result().score(), 4));
    }

    private void say(String line) {
        err.println(line);
        err.flush();
    }
}
