package io.natator.cli;

import io.natator.config.ExecutionSettings;
import io.natator.config.Numbers;
import io.natator.simulator.Evaluator;
import io.natator.study.thesis.ThesisStudy;
import java.io.PrintWriter;

/** The measurements of {@code reproduce}: speeds on any backend, also at half the spacing, then recordings on the processor. */
final class MeasurePhase {

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
        if (study.missingMeasurements() > 0) {
            CountProgress progress = new CountProgress(err);
            try (Evaluator evaluator = Evaluator.open(execution);
                    ShutdownHandler shutdown = new ShutdownHandler(evaluator, stopAfter,
                            () -> QueueOptions.sayGoodbye(err))) {
                study.measure(evaluator, execution, found -> {
                    err.println(Numbers.count(found, progress.all() == 0 ? "evaluation" : "more evaluation") + " to measure");
                    progress.expect(found);
                }, progress::done);
            } catch (InterruptedException e) {
                return false;
            }
        }
        int levels = study.missingLevels();
        int recordings = study.missingRecordings();
        err.println(Numbers.count(levels, "gait") + " to run at half the spacing, " + Numbers.count(recordings, "run")
                + " to record or measure on the processor");
        err.flush();
        Double left = stopAfter == null ? null : Math.max(1, stopAfter - (System.nanoTime() - started) / NANOSECONDS);
        Thread worker = Thread.currentThread();
        try (ShutdownHandler shutdown = new ShutdownHandler(worker::interrupt, left,
                () -> QueueOptions.sayGoodbye(err))) {
            study.converge(execution, new CountProgress(err, levels)::done);
            study.record(execution, new CountProgress(err, recordings)::done);
            return true;
        } catch (InterruptedException e) {
            return false;
        }
    }
}
