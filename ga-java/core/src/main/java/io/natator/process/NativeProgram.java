package io.natator.process;

import io.natator.protocol.RefusedSceneException;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.ResultReader;
import io.natator.protocol.SimulatorFailure;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.function.Consumer;

/**
 * Runs the native program once per call: text in, text out, within a time limit and an output limit. Nothing that the
 * program does can block the caller for longer than the limit: all three pipes are served by threads of their own, and
 * a program that is too slow or too loud is killed with all its descendants.
 */
final class NativeProgram implements AutoCloseable {

    /** A result is some 300 bytes; a scene's info a few kilobytes. */
    static final int MAX_OUTPUT_BYTES = 1 << 20;
    /** How long pipes may stay open after the program has ended, where a descendant of it holds them; they may be read for longer. */
    private static final long PIPE_GRACE_SECONDS = 2;

    private final Path program;
    private final Duration timeout;
    private final ProcessGroup processes = new ProcessGroup();
    private final ExecutorService pipes = Executors.newCachedThreadPool(task -> {
        Thread thread = new Thread(task, "simulator-pipe");
        thread.setDaemon(true);
        return thread;
    });

    /** What a finished program left: exit status, standard output, and the end of standard error as one line. */
    record Output(int exitStatus, String text, String errorText) {

        static final String NAME = "natator-sim: ";
        /** What follows the name where a line tells of a finished run of {@code converge}. */
        static final String PROGRESS = "converge: ";

        /**
         * Why there is no answer. Only what the simulator itself refuses is bad input; a shell that takes a program of
         * another machine for a script ends with the same exit status.
         *
         * @param subject for example {@code scene pool/eel}
         */
        RuntimeException failure(String subject) {
            return exitStatus == ExitStatus.BAD_INPUT && ownWords() != null ? new RefusedSceneException(reason(subject))
                    : new RequestRejectedException(reason(subject), false);
        }

        /** What follows the program's name where that last begins a line; null if none does, or if that line tells of progress. */
        private String ownWords() {
            int last = (ErrorTail.LINE_END + errorText).lastIndexOf(ErrorTail.LINE_END + NAME);
            String said = last < 0 ? PROGRESS : errorText.substring(last + NAME.length());
            return said.startsWith(PROGRESS) ? null : said;
        }

        /** Its own words, or how it ended, after the name of what it was asked for unless they have it. */
        private String reason(String subject) {
            String said = ownWords();
            if (said == null) {
                return subject + ": simulator ended with exit status " + exitStatus
                        + (errorText.isEmpty() ? "" : ", errors " + ResultReader.shown(errorText));
            }
            return said.contains("\"" + subject.replaceFirst("^scene ", "") + "\"") ? said : subject + ": " + said;
        }
    }

    NativeProgram(Path program, Duration timeout) {
        this.program = program;
        this.timeout = timeout;
    }

    /**
     * Starts the program, writes {@code input} to it, closes its standard input and waits for its end.
     *
     * @param errorLines told each line of standard error as it comes, in a thread of its own
     * @throws RequestRejectedException if it does not start
     * @throws SimulatorFailure         if it does not end in time, or prints too much
     * @throws InterruptedException     if interrupted meanwhile, or this virtual machine is shutting down; the program
     *                                  is then killed
     */
    Output call(List<String> arguments, String input, Consumer<String> errorLines)
            throws SimulatorFailure, InterruptedException {
        List<String> command = new ArrayList<>();
        command.add(program.toString());
        command.addAll(arguments);
        try {
            Process process = processes.start(command);
            try {
                long begin = System.nanoTime();
                pipes.submit(() -> {
                    try (OutputStream stdin = process.getOutputStream()) {
                        stdin.write(input.getBytes(StandardCharsets.UTF_8));
                    }
                    return null;
                });
                Future<byte[]> output = pipes.submit(() -> readLimited(process));
                Future<String> errors = pipes.submit(() -> ErrorTail.read(process.getErrorStream(), errorLines));
                return end(process, begin, output, errors);
            } finally {
                processes.end(process);
            }
        } finally {
            processes.failIfStopped();
        }
    }

    /** What a program leaves that began then, once it has ended. */
    private Output end(Process process, long begin, Future<byte[]> output, Future<String> errors)
            throws SimulatorFailure, InterruptedException {
        if (!process.waitFor(timeout.toMillis(), TimeUnit.MILLISECONDS)) {
            throw new SimulatorFailure("no answer within " + timeout.toMillis() / 1000.0 + " s");
        }
        byte[] text = await(output, process, begin);
        if (text.length > MAX_OUTPUT_BYTES) {
            throw new SimulatorFailure("more than " + MAX_OUTPUT_BYTES + " bytes of output");
        }
        return new Output(process.exitValue(), new String(text, StandardCharsets.UTF_8), await(errors, process, begin));
    }

    /** What was read of a program that began then and has ended. */
    private <T> T await(Future<T> read, Process process, long begin) throws SimulatorFailure, InterruptedException {
        while (true) {
            try {
                return read.get(PIPE_GRACE_SECONDS, TimeUnit.SECONDS);
            } catch (TimeoutException e) {
                if (processes.hasLeft(process) || System.nanoTime() - begin > timeout.toNanos()) {
                    throw new SimulatorFailure("output still open after the program ended", e);
                }
            } catch (ExecutionException e) {
                throw new SimulatorFailure("output not readable: " + e.getCause().getMessage(), e);
            }
        }
    }

    /** Reads up to one byte more than allowed; then the program is killed, since it would wait for a reader. */
    private byte[] readLimited(Process process) throws IOException {
        try (InputStream stdout = process.getInputStream()) {
            byte[] bytes = stdout.readNBytes(MAX_OUTPUT_BYTES + 1);
            if (bytes.length > MAX_OUTPUT_BYTES) {
                processes.kill(process);
            }
            return bytes;
        }
    }

    @Override
    public void close() {
        processes.close();
        pipes.shutdownNow();
    }
}
