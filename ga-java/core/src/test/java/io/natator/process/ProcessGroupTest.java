package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.JavaCommand;
import java.io.BufferedReader;
import java.io.IOException;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ProcessGroupTest {

    /** A program that starts another in a group of its own and ends as if it was killed: the other is nobody's child. */
    static final class Inner {

        private Inner() {
        }

        public static void main(String[] arguments) throws Exception {
            Process process = new ProcessGroup().start(List.of("sh", "-c", "sleep 3600 >/dev/null 2>&1 & echo $!"));
            try (BufferedReader output = process.inputReader()) {
                System.out.println(output.readLine());
            }
            process.waitFor();
            Runtime.getRuntime().halt(0);
        }
    }

    @Test
    void whatAGroupWithinAGroupLeavesBehindIsEnded() throws InterruptedException, IOException {
        ProcessHandle left;
        try (ProcessGroup group = new ProcessGroup()) {
            Process inner = group.start(JavaCommand.of(Inner.class));
            try (BufferedReader output = inner.inputReader()) {
                left = ProcessHandle.of(Long.parseLong(output.readLine())).orElseThrow();
            }
            inner.waitFor();
            assertThat(left.info().commandLine()).isPresent();
            group.end(inner);
        }

        try {
            assertThat(left.info().commandLine()).as("none, maybe of a zombie").isEmpty();
        } finally {
            left.destroyForcibly();
        }
    }
}
