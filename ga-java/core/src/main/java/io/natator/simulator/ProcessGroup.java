package io.natator.simulator;

import java.io.IOException;
import java.util.List;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.TimeUnit;

/** The native processes of one owner. None of them, nor any descendant, outlives it or this virtual machine. */
public final class ProcessGroup implements AutoCloseable {

    /** A killed process is gone at once unless the system is in trouble. */
    private static final long KILL_GRACE_SECONDS = 5;

    private final Set<Process> running = ConcurrentHashMap.newKeySet();
    private final Thread stopAtExit = new Thread(this::stop, "stop-simulators");
    private volatile boolean stopped;

    /** An empty group; one that is stopped already where this virtual machine is shutting down. */
    public ProcessGroup() {
        try {
            Runtime.getRuntime().addShutdownHook(stopAtExit);
        } catch (IllegalStateException e) {
            stopped = true;
        }
    }

    /**
     * Starts a process, which is to be handed to {@link #end} whatever happens.
     *
     * @throws SimulatorFailure     if it does not start
     * @throws InterruptedException if this group was stopped
     */
    public Process start(List<String> command) throws SimulatorFailure, InterruptedException {
        failIfStopped();
        Process process;
        try {
            process = new ProcessBuilder(command).start();
        } catch (IOException e) {
            throw new SimulatorFailure("cannot start " + command.get(0) + ": " + e.getMessage(), e);
        }
        running.add(process);
        if (stopped) {
            end(process);
        }
        failIfStopped();
        return process;
    }

    /** What a program says when we killed it, or when an interrupt from the keyboard did, says nothing about it. */
    void failIfStopped() throws InterruptedException {
        if (stopped) {
            throw new InterruptedException("stopped");
        }
    }

    /** Kills a process, should it still run, with all its descendants, and waits until it is gone. */
    public void end(Process process) {
        kill(process);
        running.remove(process);
        boolean interrupted = Thread.interrupted();
        try {
            process.waitFor(KILL_GRACE_SECONDS, TimeUnit.SECONDS);
        } catch (InterruptedException e) {
            interrupted = true;
        }
        if (interrupted) {
            Thread.currentThread().interrupt();
        }
    }

    /**
     * Kills a process with all its descendants. Not by {@link Process#destroyForcibly()}, which also closes the pipes:
     * that waits for a thread that is writing, and so for a descendant that holds the pipe open but does not read it.
     */
    static void kill(Process process) {
        if (process.isAlive()) {
            List<ProcessHandle> descendants = process.descendants().toList();
            process.toHandle().destroyForcibly();
            descendants.forEach(ProcessHandle::destroyForcibly);
        }
    }

    private void stop() {
        stopped = true;
        running.forEach(ProcessGroup::kill);
    }

    boolean isStopped() {
        return stopped;
    }

    @Override
    public void close() {
        stop();
        try {
            Runtime.getRuntime().removeShutdownHook(stopAtExit);
        } catch (IllegalStateException e) {
            // The virtual machine is already shutting down, and runs the hook itself.
        }
    }
}
