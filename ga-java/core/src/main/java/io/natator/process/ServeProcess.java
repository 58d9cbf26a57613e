package io.natator.process;

import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.ResultReader;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulatorFailure;
import java.util.List;
import java.util.concurrent.TimeUnit;

/**
 * A running {@code natator-sim serve}: requests in, answers out, one a line. To be used by one thread at a time. Nothing
 * that the program does can block that thread for longer than it is ready to wait: the pipes are served by threads of
 * their own.
 */
final class ServeProcess implements AutoCloseable {

    private static final long GRACE_MILLISECONDS = 5000;

    private final ProcessGroup group;
    private final ServeCommands.Command command;
    private final Process process;
    private final AnswerLines answers;
    private final RequestLines requests;
    private final ErrorTail errors;
    private final List<Thread> threads;
    private boolean answered;

    /**
     * Starts the program.
     *
     * @param group   to which its process belongs
     * @param command that starts it
     * @throws RequestRejectedException if it does not start
     * @throws InterruptedException     if the group was stopped
     */
    ServeProcess(ProcessGroup group, ServeCommands.Command command) throws InterruptedException {
        this.group = group;
        this.command = command;
        this.process = group.start(command.words());
        this.errors = new ErrorTail(process.getErrorStream());
        this.answers = new AnswerLines(process.getInputStream(), () -> group.kill(process));
        this.requests = new RequestLines(process.getOutputStream(), this::fail);
        this.threads = List.of(new Thread(requests, "serve-input"), new Thread(answers, "serve-output"),
                new Thread(errors, "serve-errors"));
        for (Thread thread : threads) {
            thread.setDaemon(true);
            thread.start();
        }
    }

    /** The command that started it. */
    ServeCommands.Command command() {
        return command;
    }

    /** Whether it runs and has said nothing that it was not asked. */
    boolean isReady() {
        return process.isAlive() && answers.isEmpty();
    }

    /** Sends requests, one a line. */
    void send(String lines) {
        requests.add(lines);
    }

    /**
     * The next answer.
     *
     * @throws SimulatorFailure         if none comes in time, or none will come any more
     * @throws RequestRejectedException if the program cannot work at all, as without the GPU that it was asked to use
     */
    SimulationResult receive(long nanoseconds) throws SimulatorFailure, InterruptedException {
        AnswerLines.Line line = answers.poll(nanoseconds);
        if (line == null) {
            throw new SimulatorFailure("no answer within " + Math.round(nanoseconds / 1e6) / 1e3 + " s");
        }
        if (line.fault() != null) {
            throw new SimulatorFailure(line.fault() + end());
        }
        SimulationResult result = ResultReader.read(line.text());
        answered = true;
        return result;
    }

    /** How the program ended, or that it runs on though its output is at an end. */
    private String end() throws InterruptedException {
        if (!process.waitFor(GRACE_MILLISECONDS, TimeUnit.MILLISECONDS)) {
            return ", but the program runs on";
        }
        String said = errors.text();
        int status = process.exitValue();
        if (!answered && (status == ExitStatus.BAD_INPUT || status == ExitStatus.NO_DEVICE) && !said.isEmpty()) {
            throw new RequestRejectedException(said, status == ExitStatus.BAD_INPUT);
        }
        return "; exit status " + status + (said.isEmpty() ? "" : ", errors " + ResultReader.shown(said));
    }

    /** Ends the program, to which nobody writes any more. */
    private void fail(String fault) {
        answers.fail(fault);
        group.kill(process);
    }

    /** Kills the program with all its descendants. */
    @Override
    public void close() {
        group.end(process);
        requests.close();
        threads.forEach(Thread::interrupt);
    }
}
