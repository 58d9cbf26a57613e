package io.natator.cli;

import io.natator.config.ExecutionSettings;
import io.natator.simulator.Evaluator;
import io.natator.study.thesis.ThesisStudy;
import java.io.PrintWriter;
import java.util.Locale;

/** The measurements of {@code reproduce}: speeds on any backend, then recordings and times on the processor. */
final class MeasurePhase {

    private static final double INTERVAL_SECONDS = 10;
    private static final double NANOSECONDS = 1e9;

    private final ThesisStudy study;
    private final ExecutionSettings execution;

    MeasurePhase(ThesisStudy study, ExecutionSettings execution) {
        this.study = study;
        this.execution = execution;
    }

    /**
     * Measures what is missing.
     *
     * @param stopAfter seconds, or null
     * @return whether everything is measured; false if the time was up
     */
    @SuppressWarnings("try") // The stopper works from other threads.
    boolean run(Double stopAfter, PrintWriter err) throws InterruptedException {
        long started = System.nanoTime();
        int missing = study.missingMeasurements();
        if (missing > 0) {
            err.printf("%d evaluations to measure%n", missing);
            try (Evaluator evaluator = Evaluator.open(execution);
                    ShutdownHandler shutdown = new ShutdownHandler(evaluator, stopAfter,
                            () -> QueueOptions.sayGoodbye(err))) {
                study.measure(evaluator, execution, counter(missing, err));
            } catch (InterruptedException e) {
                return false;
            }
        }
        Double left = stopAfter == null ? null : Math.max(1, stopAfter - (System.nanoTime() - started) / NANOSECONDS);
        Thread recorder = Thread.currentThread();
        int recordings = study.missingRecordings();
        err.printf("%d runs to record or time%n", recordings);
        err.flush();
        try (ShutdownHandler shutdown = new ShutdownHandler(recorder::interrupt, left,
                () -> QueueOptions.sayGoodbye(err))) {
            study.record(execution, counter(recordings, err));
            return true;
        } catch (InterruptedException e) {
            return false;
        }
    }

    /** Tells every few seconds how many are done. */
    private static Runnable counter(int all, PrintWriter err) {
        long[] state = {0, System.nanoTime()};
        return () -> {
            state[0]++;
            if ((System.nanoTime() - state[1]) / NANOSECONDS > INTERVAL_SECONDS) {
                state[1] = System.nanoTime();
                err.printf(Locale.ROOT, "%d of %d%n", state[0], all);
                err.flush();
            }
        };
    }
}
