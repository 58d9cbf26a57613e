package io.natator.process;

import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

/** Work that is stopped when this program is told to end, as by Ctrl-C: the end waits until the work is put in order and this closed. */
public final class ProgramEnd implements AutoCloseable {

    private static final long PATIENCE_SECONDS = 10;

    private final CountDownLatch closed = new CountDownLatch(1);
    private final Thread atExit;

    /**
     * Begins to watch.
     *
     * @param stop     what stops the work, from another thread
     * @param farewell done when this program is told to end, after the work has stopped
     * @throws IllegalStateException if it is told already
     */
    public ProgramEnd(Runnable stop, Runnable farewell) {
        atExit = new Thread(() -> {
            stop.run();
            try {
                isClosedWithin(TimeUnit.SECONDS.toNanos(PATIENCE_SECONDS));
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
            farewell.run();
        }, "stop-work");
        Runtime.getRuntime().addShutdownHook(atExit);
    }

    /** Whether this program was told to end: what fails then may fail because its parts are being stopped. */
    public static boolean hasBegun() {
        Thread probe = new Thread(() -> {
        });
        try {
            Runtime.getRuntime().addShutdownHook(probe);
            Runtime.getRuntime().removeShutdownHook(probe);
            return false;
        } catch (IllegalStateException e) {
            return true;
        }
    }

    /**
     * Waits until this is closed, at most so long.
     *
     * @throws InterruptedException if interrupted meanwhile
     */
    public boolean isClosedWithin(long nanoseconds) throws InterruptedException {
        return closed.await(nanoseconds, TimeUnit.NANOSECONDS);
    }

    /** To be called when the work is done, or put in order. */
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
