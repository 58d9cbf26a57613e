package io.natator.process;

import io.natator.config.Json;
import io.natator.config.Limits;
import io.natator.protocol.SimulatorFailure;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.nio.charset.StandardCharsets;
import java.util.concurrent.TimeUnit;

/** JSON lines to and from an optimizer outside this program. One thread speaks at a time; another may close it. */
public final class OptimizerPipe implements AutoCloseable {

    private static final long LOOK_NANOSECONDS = TimeUnit.MILLISECONDS.toNanos(100);

    private final OutputStream out;
    private final AnswerLines lines;
    private final Thread reader;
    private int received;
    private volatile boolean closed;

    /**
     * A pipe whose streams stay open.
     *
     * @param in  what the optimizer says
     * @param out what it is told
     */
    public OptimizerPipe(InputStream in, OutputStream out) {
        this.out = out;
        this.lines = new AnswerLines(in, () -> {
        }, Limits.LINE_BYTES);
        this.reader = new Thread(lines, "optimizer");
        reader.setDaemon(true);
        reader.start();
    }

    /** Sends a line. Whether anybody reads it is told by what is received. */
    public void send(Object message) {
        try {
            out.write((Json.line(message) + "\n").getBytes(StandardCharsets.UTF_8));
            out.flush();
        } catch (IOException e) {
            // The optimizer has ended: it says nothing more, which whoever waits for a line is told.
        }
    }

    /**
     * The next line, however long the optimizer takes.
     *
     * @throws SimulatorFailure     if none will come
     * @throws InterruptedException if this pipe is closed
     */
    public String receive() throws SimulatorFailure, InterruptedException {
        while (!closed) {
            AnswerLines.Line line = lines.poll(LOOK_NANOSECONDS);
            if (line != null && line.fault() != null && !closed) {
                throw new SimulatorFailure(line.fault());
            }
            if (line != null && !closed) {
                received++;
                return line.text();
            }
        }
        throw new InterruptedException("stopped");
    }

    /** How many lines have been received. */
    public int received() {
        return received;
    }

    /** Ends the wait for a line. */
    @Override
    public void close() {
        closed = true;
        reader.interrupt();
    }
}
