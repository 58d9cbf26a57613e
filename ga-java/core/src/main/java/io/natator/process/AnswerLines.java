package io.natator.process;

import io.natator.protocol.ResultReader;
import java.io.BufferedInputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.util.concurrent.ArrayBlockingQueue;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.TimeUnit;

/** Reads the lines that a program writes to standard output, until it closes that; to be run by a thread of its own. */
final class AnswerLines implements Runnable {

    /** A result is some 400 bytes. */
    static final int MAX_LINE_BYTES = 1 << 20;
    /** Lines that wait to be taken; a program that writes more than it was asked for blocks itself. */
    private static final int QUEUED_LINES = 4096;

    private final InputStream stdout;
    private final Runnable kill;
    private final int maxBytes;
    private final BlockingQueue<Line> lines = new ArrayBlockingQueue<>(QUEUED_LINES);

    /** A line of output; or, with a fault, that no more will come and why. */
    record Line(String text, String fault) {
    }

    /**
     * Those of a program's standard output.
     *
     * @param kill ends the program, of which no more will be read
     */
    AnswerLines(InputStream stdout, Runnable kill) {
        this(stdout, kill, MAX_LINE_BYTES);
    }

    /** Those of a program's standard output, with lines of up to so many bytes. */
    AnswerLines(InputStream stdout, Runnable kill, int maxBytes) {
        this.stdout = stdout;
        this.kill = kill;
        this.maxBytes = maxBytes;
    }

    /** The next line, or null if none comes in time. */
    Line poll(long nanoseconds) throws InterruptedException {
        return lines.poll(nanoseconds, TimeUnit.NANOSECONDS);
    }

    /** Whether no line waits to be taken. */
    boolean isEmpty() {
        return lines.isEmpty();
    }

    /** Tells whoever waits for a line, after those that are there, that no more will come and why. */
    void fail(String fault) {
        try {
            lines.put(new Line(null, fault));
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    @Override
    public void run() {
        try {
            fail(read());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    /** Passes lines on as long as there are any; why no more will come. */
    private String read() throws InterruptedException {
        try (InputStream buffered = new BufferedInputStream(stdout)) {
            ByteArrayOutputStream line = new ByteArrayOutputStream();
            for (int next = buffered.read(); next >= 0; next = buffered.read()) {
                if (next == '\n') {
                    lines.put(new Line(line.toString(StandardCharsets.UTF_8), null));
                    line.reset();
                } else if (line.size() == maxBytes) {
                    kill.run();
                    return "more than " + maxBytes + " bytes in one line";
                } else {
                    line.write(next);
                }
            }
            return line.size() == 0 ? "output ended"
                    : "output ended within a line: " + ResultReader.shown(line.toString(StandardCharsets.UTF_8));
        } catch (IOException e) {
            return "output not readable: " + e.getMessage();
        } catch (RuntimeException | Error e) {
            // Such as a lack of memory. Whoever waits for a line is to be told at once: nobody reads on.
            kill.run();
            return "output not readable: " + ResultReader.shown(e.toString());
        }
    }
}
