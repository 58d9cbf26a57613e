package io.natator.cli;

import io.natator.base.Numbers;
import io.natator.checkpoint.RunFolder;
import io.natator.evolution.Individual;
import io.natator.run.EvolutionRun;
import io.natator.run.RunQueue;
import java.io.PrintWriter;
import java.util.Locale;

/** Tells how a study goes: a line for each finished run, and every few seconds one for the whole. */
abstract class StudyProgress implements RunQueue.Watcher {

    private static final double INTERVAL_SECONDS = 10;
    private static final double NANOSECONDS = 1e9;

    private final PrintWriter out;
    private final int runs;
    private final long evaluations;
    private final long before;
    private final long started = System.nanoTime();
    private long said = started;
    private long done;
    private int finished;

    /**
     * Starts the clock.
     *
     * @param runs        of the study
     * @param finished    of them already
     * @param evaluations that all runs take together, as far as is known
     * @param before      of them already recorded
     */
    StudyProgress(int runs, int finished, long evaluations, long before, PrintWriter out) {
        this.out = out;
        this.runs = runs;
        this.evaluations = evaluations;
        this.before = before;
        this.finished = finished;
    }

    @Override
    public synchronized void evaluated() {
        done++;
        long now = System.nanoTime();
        if ((now - said) / NANOSECONDS >= INTERVAL_SECONDS) {
            said = now;
            double rate = done / ((now - started) / NANOSECONDS);
            out.printf(Locale.ROOT, "%d of %d runs, %d of %d evaluations, %.1f evaluations/s, left %s%n", finished, runs,
                    before + done, evaluations, rate,
                    ProgressEstimate.readable(Math.round(Math.max(evaluations - before - done, 0) / rate)));
            out.flush();
        }
    }

    @Override
    public synchronized void said(String line) {
        out.println(line);
        out.flush();
    }

    @Override
    public synchronized void finished(RunFolder run, EvolutionRun.Outcome outcome) {
        finished++;
        Individual best = outcome.state().best();
        out.printf("%s  best %s%n", run.directory(), Numbers.fixed(best == null ? 0 : best.result().score(), 4));
        out.flush();
    }
}
