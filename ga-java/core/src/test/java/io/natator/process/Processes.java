package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.function.BooleanSupplier;
import java.util.stream.Stream;

/** What this virtual machine holds of the operating system. */
public final class Processes {

    private static final long PATIENCE_SECONDS = 300;

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
        await(() -> ProcessHandle.current().descendants().findAny().isEmpty());
        assertThat(ProcessHandle.current().descendants().map(child -> child.info().toString())).isEmpty();
    }

    /** Waits until a child runs. */
    static void awaitChild() throws InterruptedException {
        await(() -> ProcessHandle.current().children().findAny().isPresent());
        assertThat(ProcessHandle.current().children()).isNotEmpty();
    }

    /** Waits for file handles of processes that have just ended. */
    public static void assertThatOpenFilesAreAtMost(long most) throws InterruptedException, IOException {
        await(() -> {
            try {
                return openFiles() <= most;
            } catch (IOException e) {
                throw new UncheckedIOException(e);
            }
        });
        assertThat(openFiles()).isLessThanOrEqualTo(most);
    }

    /** Waits until something holds, but not for ever; the processes that tests leave alone last longer. */
    private static void await(BooleanSupplier holds) throws InterruptedException {
        long end = System.nanoTime() + PATIENCE_SECONDS * 1_000_000_000L;
        while (!holds.getAsBoolean() && System.nanoTime() < end) {
            Thread.sleep(10);
        }
    }
}
