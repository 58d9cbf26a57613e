package io.natator.cli;

import java.io.PrintWriter;
import java.util.Locale;
import java.util.function.LongSupplier;

/** Tells every few seconds how many are done, of all that are known by then. */
final class CountProgress {

    private static final long INTERVAL_NANOSECONDS = 10_000_000_000L;

    private final PrintWriter out;
    private final LongSupplier clock;
    private long said;
    private int done;
    private int all;

    /** Of none yet. */
    CountProgress(PrintWriter out) {
        this(out, System::nanoTime);
    }

    /** Of as many. */
    CountProgress(PrintWriter out, int all) {
        this(out);
        this.all = all;
    }

    /** With a clock in nanoseconds. */
    CountProgress(PrintWriter out, LongSupplier clock) {
        this.out = out;
        this.clock = clock;
        this.said = clock.getAsLong();
    }

    synchronized int all() {
        return all;
    }

    /** From here on as many are left: those that were not done again, and those that became known. */
    synchronized void expect(int left) {
        all = done + left;
    }

    synchronized void done() {
        done++;
        long now = clock.getAsLong();
        if (now - said > INTERVAL_NANOSECONDS) {
            said = now;
            out.printf(Locale.ROOT, "%d of %d%n", done, all);
            out.flush();
        }
    }
}
