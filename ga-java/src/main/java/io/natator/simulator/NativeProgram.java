package io.natator.simulator;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

/**
 * Runs the native program once per call: text in, text out, within a time limit and an output limit. Nothing that the
 * program does can block the caller for longer than the limit: all three pipes are served by threads of their own, and
 * a program that is too slow or too loud is killed with all its descendants.
 */
final class NativeProgram implements AutoCloseable {

    /** A result is some 300 bytes; a scene's info a few kilobytes. */
    static final int MAX_OUTPUT_BYTES = 1 << 20;
    private static final int KEPT_ERROR_BYTES = 4096;
    /** How long pipes may stay open after the program has ended, held by a descendant of it. */
    private static final long PIPE_GRACE_SECONDS = 2;

    private final Path program;
    private final Duration timeout;
    private final Set<Process> running = ConcurrentHashMap.newKeySet();
    private final Thread stopAtExit = new Thread(this::stop, "stop-simulators");
    private volatile boolean stopped;
    private final ExecutorService pipes = Executors.newCachedThreadPool(task -> {
        Thread thread = new Thread(task, "simulator-pipe");
        thread.setDaemon(true);
        return thread;
    });

    /** What a finished program left: exit status, standard output, and the end of standard error as one line. */
    record Output(int exitStatus, String text, String errorText) {
    }

    NativeProgram(Path program, Duration timeout) {
        this.program = program;
        this.timeout = timeout;
        Runtime.getRuntime().addShutdownHook(stopAtExit);
    }

    /**
     * Starts the program, writes {@code input} to it, closes its standard input and waits for its end.
     *
     * @throws SimulatorFailure     if it does not start, does not end in time, or prints too much
     * @throws InterruptedException if interrupted meanwhile, or this virtual machine is shutting down; the program is
     *                              then killed
     */
    Output call(List<String> arguments, String input) throws SimulatorFailure, InterruptedException {
        try {
            return start(arguments, input);
        } finally {
            failIfStopped();
        }
    }

    /** What a program says when we killed it, or when an interrupt from the keyboard did, says nothing about it. */
    private void failIfStopped() throws InterruptedException {
        if (stopped) {
            throw new InterruptedException("stopped");
        }
    }

    private Output start(List<String> arguments, String input) throws SimulatorFailure, InterruptedException {
        failIfStopped();
        List<String> command = new ArrayList<>();
        command.add(program.toString());
        command.addAll(arguments);
        Process process;
        try {
            process = new ProcessBuilder(command).start();
        } catch (IOException e) {
            throw new SimulatorFailure("cannot start " + program + ": " + e.getMessage(), e);
        }
        running.add(process);
        try {
            return converse(process, input);
        } finally {
            kill(process);
            running.remove(process);
        }
    }

    private Output converse(Process process, String input) throws SimulatorFailure, InterruptedException {
        pipes.submit(() -> write(process, input));
        Future<byte[]> output = pipes.submit(() -> readLimited(process));
        Future<byte[]> errors = pipes.submit(() -> readTail(process.getErrorStream()));
        if (!process.waitFor(timeout.toMillis(), TimeUnit.MILLISECONDS)) {
            throw new SimulatorFailure("no answer within " + timeout.toMillis() / 1000.0 + " s");
        }
        byte[] text = await(output);
        if (text.length > MAX_OUTPUT_BYTES) {
            throw new SimulatorFailure("more than " + MAX_OUTPUT_BYTES + " bytes of output");
        }
        String lastErrors = new String(await(errors), StandardCharsets.UTF_8).strip().replaceAll("\\s*\\R\\s*", " | ");
        return new Output(process.exitValue(), new String(text, StandardCharsets.UTF_8), lastErrors);
    }

    private static byte[] await(Future<byte[]> bytes) throws SimulatorFailure, InterruptedException {
        try {
            return bytes.get(PIPE_GRACE_SECONDS, TimeUnit.SECONDS);
        } catch (TimeoutException e) {
            throw new SimulatorFailure("output still open after the program ended", e);
        } catch (ExecutionException e) {
            throw new SimulatorFailure("output not readable: " + e.getCause().getMessage(), e);
        }
    }

    private static Void write(Process process, String input) throws IOException {
        try (OutputStream stdin = process.getOutputStream()) {
            stdin.write(input.getBytes(StandardCharsets.UTF_8));
        }
        return null;
    }

    /** Reads up to one byte more than allowed; then the program is killed, since it would wait for a reader. */
    private static byte[] readLimited(Process process) throws IOException {
        try (InputStream stdout = process.getInputStream()) {
            byte[] bytes = stdout.readNBytes(MAX_OUTPUT_BYTES + 1);
            if (bytes.length > MAX_OUTPUT_BYTES) {
                kill(process);
            }
            return bytes;
        }
    }

    private static byte[] readTail(InputStream stderr) throws IOException {
        try (stderr) {
            ByteArrayOutputStream kept = new ByteArrayOutputStream();
            byte[] buffer = new byte[KEPT_ERROR_BYTES];
            for (int count = stderr.read(buffer); count >= 0; count = stderr.read(buffer)) {
                if (kept.size() + count > 2 * KEPT_ERROR_BYTES) {
                    kept.reset();
                }
                kept.write(buffer, 0, count);
            }
            return kept.toByteArray();
        }
    }

    /**
     * Kills the program with all its descendants. Not by {@link Process#destroyForcibly()}, which also closes the pipes:
     * that waits for a thread that is writing, and so for a descendant that holds the pipe open but does not read it.
     */
    private static void kill(Process process) {
        if (process.isAlive()) {
            List<ProcessHandle> descendants = process.descendants().toList();
            process.toHandle().destroyForcibly();
            descendants.forEach(ProcessHandle::destroyForcibly);
        }
    }

    private void stop() {
        stopped = true;
        running.forEach(NativeProgram::kill);
    }

    @Override
    public void close() {
        stop();
        pipes.shutdownNow();
        try {
            Runtime.getRuntime().removeShutdownHook(stopAtExit);
        } catch (IllegalStateException e) {
            // The virtual machine is already shutting down, and runs the hook itself.
        }
    }
}
