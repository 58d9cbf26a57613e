package io.natator.process;

import io.natator.protocol.RequestRejectedException;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.DirectoryIteratorException;
import java.nio.file.DirectoryStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.UUID;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;

/** The native processes of one owner. None of them, nor any descendant, outlives it or this virtual machine. */
public final class ProcessGroup implements AutoCloseable {

    /** A killed process is gone at once unless the system is in trouble. */
    private static final long KILL_GRACE_SECONDS = 5;

    /**
     * Environment variable of a process and of all its descendants: which start they come from. One id after another where
     * a process that was started so starts others so, each ended by {@link #END}: every one of the starts finds them.
     */
    private static final String MARK = "NATATOR_STARTED_AS";
    private static final String END = ";";
    private static final Path PROCESSES = Path.of("/proc");

    private final String name = UUID.randomUUID().toString();
    private final AtomicInteger started = new AtomicInteger();
    private final Map<Process, String> running = new ConcurrentHashMap<>();
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
     * @throws RequestRejectedException if it does not start, which is not the fault of what it is for
     * @throws InterruptedException     if this group was stopped
     */
    public Process start(List<String> command) throws InterruptedException {
        failIfStopped();
        Process process;
        String mark = name + '.' + started.incrementAndGet() + END;
        try {
            ProcessBuilder builder = new ProcessBuilder(command);
            builder.environment().merge(MARK, mark, String::concat);
            process = builder.start();
        } catch (IOException e) {
            throw new RequestRejectedException("cannot start " + command.get(0) + ": " + e.getMessage(), false);
        }
        running.put(process, mark);
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

    /** Whether what a process has started runs on, now that it has ended, and may hold its pipes open; where there is no /proc, yes. */
    boolean hasLeft(Process process) {
        try {
            return !marked(running.get(process)).isEmpty();
        } catch (IOException | DirectoryIteratorException e) {
            return true;
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
    void kill(Process process) {
        String mark = running.get(process);
        if (process.isAlive()) {
            List<ProcessHandle> descendants = process.descendants().toList();
            process.toHandle().destroyForcibly();
            descendants.forEach(ProcessHandle::destroyForcibly);
            if (mark != null) {
                killAllMarked(mark);
            }
        }
    }

    /**
     * Kills what a process started while its descendants were being counted, or what has lost its parent: it is nobody's
     * child by now, and may have started more meanwhile. Where there is no /proc such processes stay.
     */
    private static void killAllMarked(String mark) {
        long end = System.nanoTime() + TimeUnit.SECONDS.toNanos(KILL_GRACE_SECONDS);
        while (killMarked(mark) && System.nanoTime() < end) {
            Thread.yield();
        }
    }

    /** Whether there was any. */
    private static boolean killMarked(String mark) {
        boolean any = false;
        try {
            for (ProcessHandle each : marked(mark)) {
                any |= each.destroyForcibly();
            }
        } catch (IOException | DirectoryIteratorException e) {
            return false;
        }
        return any;
    }

    private static List<ProcessHandle> marked(String mark) throws IOException {
        List<ProcessHandle> found = new ArrayList<>();
        try (DirectoryStream<Path> folders = Files.newDirectoryStream(PROCESSES, "[0-9]*")) {
            for (Path folder : folders) {
                if (isMarked(folder, mark)) {
                    ProcessHandle.of(Long.parseLong(folder.getFileName().toString())).ifPresent(found::add);
                }
            }
        }
        return found;
    }

    private static boolean isMarked(Path process, String mark) {
        try {
            String environment = Files.readString(process.resolve("environ"), StandardCharsets.ISO_8859_1);
            return environment.contains(mark);
        } catch (IOException e) {
            return false;  // it has ended, or is another user's
        }
    }

    private void stop() {
        stopped = true;
        running.keySet().forEach(this::kill);
        if (started.get() > 0) {
            killAllMarked(name + '.');  // what a program left behind that ended by itself
        }
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
