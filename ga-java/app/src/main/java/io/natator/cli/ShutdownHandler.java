package io.natator.cli;

import io.natator.base.Numbers;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.EvolutionStoppedException;
import io.natator.process.Evaluator;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

/**
 * Ends evolutions early, after a time or when this program is told to end: it closes their evaluator. Then they stop
 * with all that was finished written; what they were evaluating is abandoned.
 */
final class ShutdownHandler implements AutoCloseable {

    /** For the evolutions to be put in order when this program is told to end. */
    private static final long PATIENCE_SECONDS = 10;

    private final Runnable stop;
    private final Long deadline;
    private final CountDownLatch closed = new CountDownLatch(1);
    private final Thread atExit;
    private volatile boolean timeIsUp;

    /**
     * Begins to watch evolutions.
     *
     * @param evaluator of theirs
     * @param seconds after which to stop, or null
     * @param farewell done when this program is told to end, after everything was written
     */
    ShutdownHandler(Evaluator evaluator, Double seconds, Runnable farewell) {
        this(evaluator::close, seconds, farewell);
    }

    /** Begins to watch something that can be stopped in its own way. */
    ShutdownHandler(Runnable stop, Double seconds, Runnable farewell) {
        this.stop = stop;
        this.deadline = seconds == null ? null : System.nanoTime() + Math.round(seconds * 1e9);
        this.atExit = new Thread(() -> atExit(farewell), "stop-work");
        Runtime.getRuntime().addShutdownHook(atExit);
        if (deadline != null) {
            Thread timer = new Thread(this::waitForDeadline, "stop-after");
            timer.setDaemon(true);
            timer.start();
        }
    }

    private void atExit(Runnable farewell) {
        stop.run();
        try {
            closed.await(PATIENCE_SECONDS, TimeUnit.SECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        farewell.run();
    }

    private void waitForDeadline() {
        try {
            if (!closed.await(deadline - System.nanoTime(), TimeUnit.NANOSECONDS)) {
                timeIsUp = true;
                stop.run();
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    /** Whether the time that was given is over. */
    boolean isTimeUp() {
        return timeIsUp;
    }

    /**
     * What stops one evolution before a generation that it will probably not finish in time, judged by the last one:
     * where a generation is evaluated at once, a part of it would be lost.
     */
    EvolutionListener beforeLateGenerations() {
        return new EvolutionListener() {
            private long started = System.nanoTime();

            @Override
            public void generationStarted(int generation, int simulations) {
                started = System.nanoTime();
            }

            @Override
            public void generationFinished(EvolutionState state) {
                long now = System.nanoTime();
                if (deadline != null && now + (now - started) > deadline) {
                    timeIsUp = true;
                    throw new EvolutionStoppedException("stopped after generation " + state.generation() + " and "
                            + Numbers.count(state.evaluations(), "evaluation"));
                }
            }
        };
    }

    /** Ends the watch; to be called when everything is written. */
    @Override
    public void close() {
        closed.countDown();
        try {
            Runtime.getRuntime().removeShutdownHook(atExit);
        } catch (IllegalStateException e) {
            // This program is ending already, and runs the hook itself.
        }
    }
}
