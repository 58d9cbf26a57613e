package io.natator.stream;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.process.ErrorTail;
import io.natator.process.ExitStatus;
import io.natator.process.ProcessGroup;
import io.natator.protocol.RefusedSceneException;
import io.natator.protocol.RequestRejectedException;
import java.io.BufferedInputStream;
import java.io.IOException;
import java.io.InterruptedIOException;
import java.io.OutputStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ArrayBlockingQueue;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.TimeUnit;

/**
 * A running {@code natator-sim stream}. One thread takes its messages; any thread may send commands or close it.
 * Neither it nor any descendant of it outlives {@link #close} or this virtual machine.
 */
public final class StreamProcess implements AutoCloseable {

    /** Commands that wait to be written; a program that takes none any more must not cost memory. */
    static final int QUEUED_COMMANDS = 1024;
    private static final int BUFFER_BYTES = 1 << 16;
    private static final long GRACE_MILLISECONDS = 5000;

    private final ProcessGroup group = new ProcessGroup();
    private final Process process;
    private final StreamReader reader;
    private final BlockingQueue<byte[]> commands = new ArrayBlockingQueue<>(QUEUED_COMMANDS);
    private final ErrorTail errors;
    private final List<Thread> threads;
    private volatile boolean closed;
    private boolean begun;

    /**
     * Starts the program.
     *
     * @param simulator the native program
     * @throws RequestRejectedException if it does not start
     * @throws InterruptedException     if this virtual machine is shutting down
     */
    public StreamProcess(Path simulator, StreamOptions options) throws InterruptedException {
        List<String> command = new ArrayList<>(List.of(simulator.toString()));
        command.addAll(options.arguments());
        try {
            process = group.start(command);
        } catch (RequestRejectedException e) {
            group.close();
            throw e;
        }
        reader = new StreamReader(new BufferedInputStream(process.getInputStream(), BUFFER_BYTES));
        errors = new ErrorTail(process.getErrorStream());
        threads = List.of(new Thread(this::write, "stream-input"), new Thread(errors, "stream-errors"));
        for (Thread thread : threads) {
            thread.setDaemon(true);
            thread.start();
        }
    }

    /**
     * Whether the program takes what it would be started with; it is ended before it simulates.
     *
     * @throws RefusedSceneException if it refuses that: one line says why
     * @throws IOException           if it ends in any other way
     * @throws InterruptedException  if this virtual machine is shutting down
     */
    public static void check(Path simulator, StreamOptions options) throws IOException, InterruptedException {
        try (StreamProcess process = new StreamProcess(simulator, options)) {
            process.next();
        }
    }

    /** Sends a command; see {@link #send(String)}. */
    public void send(JsonNode command) throws StreamException {
        send(command.toString());
    }

    /**
     * Sends a command without waiting.
     *
     * @param command one JSON object, on one line
     * @throws StreamException          if the program has left too many commands unread
     * @throws IllegalArgumentException if the command holds a line feed
     */
    public void send(String command) throws StreamException {
        if (command.indexOf('\n') >= 0) {
            throw new IllegalArgumentException("a command is one line");
        }
        if (!commands.offer((command + "\n").getBytes(StandardCharsets.UTF_8)) && !closed) {
            throw new StreamException("simulator has left " + QUEUED_COMMANDS + " commands unread");
        }
    }

    /** Grants so many frames more; see {@link #send(String)}. */
    public void grant(int frames) throws StreamException {
        send("{\"do\":\"credit\",\"frames\":" + frames + "}");
    }

    /**
     * Waits for the next message.
     *
     * @return the message, or null if the program has ended with exit status 0, or {@link #close} was called
     * @throws InvalidInputException if the program refused what it was started with: one line says why
     * @throws StreamException       if it ended in any other way, or broke the protocol
     * @throws IOException           if its output cannot be read
     */
    public StreamMessage next() throws IOException {
        StreamMessage message;
        try {
            message = reader.next();
        } catch (IOException e) {
            if (closed) {
                return null;
            }
            throw e instanceof StreamException broken && broken.isAtEnd()
                    ? new StreamException(e.getMessage() + end(), e) : e;
        }
        if (message == null && !closed) {
            failUnlessDone();
        }
        begun |= message != null;
        return message;
    }

    private void failUnlessDone() throws IOException {
        String how = end();
        if (process.isAlive()) {
            throw new StreamException("simulator closed its output" + how);
        }
        int status = process.exitValue();
        if (status == ExitStatus.BAD_INPUT && !begun && !said().isEmpty()) {
            throw new RefusedSceneException(said());
        }
        if (status != 0 && !closed) {
            throw new StreamException("simulator ended" + how);
        }
    }

    /** How the program ended, or that it runs on though its output is at an end. */
    private String end() throws IOException {
        try {
            if (!process.waitFor(GRACE_MILLISECONDS, TimeUnit.MILLISECONDS)) {
                return ", but runs on";
            }
        } catch (InterruptedException e) {
            throw interrupted();
        }
        String said = said();
        return "; exit status " + process.exitValue() + (said.isEmpty() ? "" : ", errors \"" + said + '"');
    }

    private String said() throws IOException {
        try {
            return errors.text();
        } catch (InterruptedException e) {
            throw interrupted();
        }
    }

    private static InterruptedIOException interrupted() {
        Thread.currentThread().interrupt();
        return new InterruptedIOException("interrupted");
    }

    private void write() {
        try (OutputStream stdin = process.getOutputStream()) {
            while (true) {
                stdin.write(commands.take());
                stdin.flush();
            }
        } catch (IOException e) {
            // The program has closed its input or has ended: what it says, or does not, tells.
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    /** Kills the program with all its descendants; a thread that waits for a message then gets null. */
    @Override
    public void close() {
        closed = true;
        group.end(process);
        group.close();
        threads.forEach(Thread::interrupt);
    }
}
