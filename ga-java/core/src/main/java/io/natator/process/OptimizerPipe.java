package io.natator.process;

import io.natator.config.Json;
import io.natator.config.Limits;
import io.natator.protocol.SimulatorFailure;
import java.io.InputStream;
import java.io.OutputStream;
import java.util.List;
import java.util.concurrent.TimeUnit;

/**
 * JSON lines to and from an optimizer outside this program. One thread speaks at a time; another may close it. Both streams are served by threads
 * of their own, so that nobody is blocked by an optimizer that does not read.
 */
public final class OptimizerPipe implements AutoCloseable {

    private static final long LOOK_NANOSECONDS = TimeUnit.MILLISECONDS.toNanos(100);
    private static final long GRACE_MILLISECONDS = 1000;

    private final AnswerLines lines;
    private final RequestLines requests;
    private final Thread reader;
    private final Thread writer;
    private int received;
    private volatile boolean closed;

    /**
     * A pipe of two streams.
     *
     * @param in  what the optimizer says
     * @param out what it is told; closed with this pipe
     */
    public OptimizerPipe(InputStream in, OutputStream out) {
        this.lines = new AnswerLines(in, () -> {
        }, Limits.LINE_BYTES);
        this.requests = new RequestLines(out, lines::fail);
        this.reader = new Thread(lines, "optimizer-output");
        this.writer = new Thread(requests, "optimizer-input");
        for (Thread thread : List.of(reader, writer)) {
            thread.setDaemon(true);
            thread.start();
        }
    }

    /** Sends a line. Whether anybody reads it is told by what is received. */
    public void send(Object message) {
        requests.add(Json.line(message) + "\n");
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

    /** Ends the wait for a line, when the optimizer has been told all; it has a second to read that. */
    @Override
    public void close() {
        closed = true;
        reader.interrupt();
        requests.close();
        try {
            writer.join(GRACE_MILLISECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
