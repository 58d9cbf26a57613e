package io.natator.cli;

import io.natator.base.Numbers;
import io.natator.checkpoint.RunWriter;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionStoppedException;
import io.natator.evolution.Individual;
import io.natator.process.Evaluator;
import io.natator.run.EvolutionRun;
import io.natator.run.PlannedRun;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.stream.IntStream;
import java.util.stream.LongStream;

/** Evolutions that differ in their seeds, as far as they are not finished: tells of each, and every few seconds of all. */
final class SeedRuns {

    private static final double INTERVAL_SECONDS = 10;
    private static final double NANOSECONDS = 1e9;

    private final List<PlannedRun> runs;
    private final long evaluations;
    private final long before;
    private final PrintWriter err;
    private final long started = System.nanoTime();
    private long said = started;
    private long done;

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
        this.evaluations = seeds * new ProgressEstimate(settings, System::nanoTime).expected();
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
        for (PlannedRun run : runs) {
            run.checkScene(execution.simulator());
        }
        Queue<PlannedRun> waiting = new ConcurrentLinkedQueue<>(
                runs.stream().filter(run -> !run.isFinished()).toList());
        try (Evaluator evaluator = EvolutionRun.open(execution);
                ShutdownHandler shutdown = new ShutdownHandler(evaluator, stopAfter,
                        () -> say("interrupted; the same command continues"))) {
            ExecutorService threads = Executors.newFixedThreadPool(atOnce);
            try {
                List<Future<?>> lanes = IntStream.range(0, atOnce)
                        .<Future<?>>mapToObj(
                                i -> threads.submit(() -> carryOut(waiting, execution, evaluator, shutdown)))
                        .toList();
                for (Future<?> lane : lanes) {
                    lane.get();
                }
            } finally {
                threads.shutdown();
                threads.awaitTermination(1, TimeUnit.MINUTES);
            }
        } catch (ExecutionException e) {
            if (e.getCause() instanceof RuntimeException cause) {
                throw cause;
            }
            throw new IllegalStateException(e.getCause());
        }
    }

    /** One after another as long as any wait, or until the evaluator is closed; if one fails, this closes it. */
    private void carryOut(Queue<PlannedRun> waiting, ExecutionSettings execution, Evaluator evaluator,
            ShutdownHandler shutdown) {
        try {
            for (PlannedRun run = waiting.poll(); run != null; run = waiting.poll()) {
                carryOut(run, execution, evaluator, shutdown);
            }
        } catch (EvolutionStoppedException | InterruptedException e) {
            return;
        } catch (RuntimeException | Error e) {
            evaluator.close();
            throw e;
        }
    }

    private void carryOut(PlannedRun run, ExecutionSettings execution, Evaluator evaluator, ShutdownHandler shutdown)
            throws InterruptedException {
        try (RunWriter folder = run.open()) {
            long recorded = folder.recorded().end();
            List<EvolutionListener> listeners = new ArrayList<>(List.of(new EvolutionListener() {
                @Override
                public void evaluated(EvaluationRecord evaluation) {
                    if (evaluation.result().id() >= recorded) {
                        count();
                    }
                }
            }));
            if (execution.inBatches()) {
                listeners.add(shutdown.beforeLateGenerations());
            }
            Individual best = new EvolutionRun(folder)
                    .run(execution, evaluator, listeners.toArray(EvolutionListener[]::new)).state().best();
            say(folder.directory() + "  best " + Numbers.fixed(best == null ? 0 : best.result().score(), 4));
        }
    }

    /** Counts an evaluation that was not recorded before. */
    private synchronized void count() {
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

    private synchronized void say(String line) {
        err.println(line);
        err.flush();
    }
}
