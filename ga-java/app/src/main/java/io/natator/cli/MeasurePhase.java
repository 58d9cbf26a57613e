package io.natator.cli;

import io.natator.config.ExecutionSettings;
import io.natator.simulator.Evaluator;
import io.natator.study.thesis.ThesisStudy;
import java.io.PrintWriter;
import java.util.Locale;

/** The measurements of {@code reproduce}: speeds on any backend, also at half the spacing, then recordings on the processor. */
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
        int levels = study.missingLevels();
        int recordings = study.missingRecordings();
        err.printf("%d gaits to run at half the spacing, %d runs to record or measure on the processor%n", levels, recordings);
        err.flush();
        Double left = stopAfter == null ? null : Math.max(1, stopAfter - (System.nanoTime() - started) / NANOSECONDS);
        Thread worker = Thread.currentThread();
        try (ShutdownHandler shutdown = new ShutdownHandler(worker::interrupt, left,
                () -> QueueOptions.sayGoodbye(err))) {
            study.converge(execution, counter(levels, err));
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
