package io.natator.process;

import static org.assertj.core.api.Assertions.fail;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.concurrent.Callable;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;

/** What this virtual machine holds of the operating system. */
public final class Processes {

    private static final long PATIENCE_SECONDS = 600;

    private Processes() {
    }

    /** Open file handles. */
    public static long openFiles() throws IOException {
        try (Stream<Path> files = Files.list(Path.of("/proc/self/fd"))) {
            return files.count();
        }
    }

    /** Waits for processes that were just killed; zombies count as left. */
    public static void assertThatNoChildIsLeft() throws InterruptedException {
        await("the end of all children", () -> ProcessHandle.current().descendants().findAny().isEmpty());
    }

    /** Waits until a child runs. */
    static void awaitChild() throws InterruptedException {
        await("a child", () -> ProcessHandle.current().children().findAny().isPresent());
    }

    /** Waits for file handles of processes that have just ended. */
    public static void assertThatOpenFilesAreAtMost(long most) throws InterruptedException {
        await("at most " + most + " open files", () -> openFiles() <= most);
    }

    /** Waits until something holds, far longer than it can take; the processes that tests leave alone last longer. */
    public static void await(String what, Callable<Boolean> holds) throws InterruptedException {
        long end = System.nanoTime() + TimeUnit.SECONDS.toNanos(PATIENCE_SECONDS);
        try {
            while (!holds.call()) {
                if (System.nanoTime() > end) {
                    fail("waited in vain: %s; children: %s", what,
                            ProcessHandle.current().descendants().map(child -> child.info().toString()).toList());
                }
                Thread.sleep(5);
            }
        } catch (InterruptedException | RuntimeException e) {
            throw e;
        } catch (Exception e) {
            throw new IllegalStateException(what, e);
        }
    }
}
