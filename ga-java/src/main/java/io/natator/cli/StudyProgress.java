package io.natator.cli;

import io.natator.study.optimizer.OptimizerStudy;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.Locale;

/** Tells how a study goes: a line for each finished run, and every few seconds one for the whole. */
abstract class StudyProgress implements OptimizerStudy.Watcher {

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

    StudyProgress(OptimizerStudy study, PrintWriter out) {
        this.out = out;
        this.runs = study.size();
        this.evaluations = study.evaluations();
        this.before = study.recorded();
        this.finished = study.finished();
    }

    @Override
    public synchronized void evaluated() {
        done++;
        long now = System.nanoTime();
        if ((now - said) / NANOSECONDS >= INTERVAL_SECONDS) {
            said = now;
            double rate = done / ((now - started) / NANOSECONDS);
            out.printf(Locale.ROOT, "%d of %d runs, %d of %d evaluations, %.1f/s, left %s%n", finished, runs,
                    before + done, evaluations, rate,
                    Pace.readable(Math.round((evaluations - before - done) / rate)));
            out.flush();
        }
    }

    @Override
    public synchronized void finished(Path run, double bestDistance) {
        finished++;
        out.printf(Locale.ROOT, "%s  best %.4f%n", run, bestDistance);
        out.flush();
    }
}
