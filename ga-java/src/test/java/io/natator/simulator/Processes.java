package io.natator.simulator;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.stream.Stream;

/** What this virtual machine holds of the operating system. */
public final class Processes {

    private Processes() {
    }

    /** Open file handles. */
    public static long openFiles() throws IOException {
        try (Stream<Path> files = Files.list(Path.of("/proc/self/fd"))) {
            return files.count();
        }
    }

    /** Waits a little for processes that were just killed; zombies count as left. */
    public static void assertThatNoChildIsLeft() throws InterruptedException {
        for (int i = 0; i < 100 && ProcessHandle.current().descendants().findAny().isPresent(); i++) {
            Thread.sleep(20);
        }
        assertThat(ProcessHandle.current().descendants().map(child -> child.info().toString())).isEmpty();
    }
}
