package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.JavaCommand;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Commands that are told to end while a simulator works for them. */
class InterruptedCommandTest extends FakeSimulatorTest {

    private static final int TERMINATED = 128 + 15;

    /** The program, which does not end before it has told of an error. */
    static final class Patient {

        public static void main(String[] arguments) {
            CountDownLatch told = new CountDownLatch(1);
            Runtime.getRuntime().addShutdownHook(new Thread(() -> {
                try {
                    told.await();
                } catch (InterruptedException e) {
                    Thread.currentThread().interrupt();
                }
            }));
            Main.run(Main.commandLine().setExecutionExceptionHandler((error, failed, parsed) -> {
                try {
                    return OneLineErrors.failure(error, failed, parsed);
                } finally {
                    told.countDown();
                }
            }), arguments);
        }
    }

    @ParameterizedTest
    @ValueSource(strings = "page pool/eel --output NEW.html")
    void whatTheyWereDoingIsNoFailure(String command) throws IOException, InterruptedException {
        String name = command.split(" ")[0];
        List<String> words = JavaCommand.of(Patient.class, command.replace("NEW", path("new")).split(" "));
        words.addAll(List.of("--simulator-path", path("fake-simulator.sh")));
        Path log = folder.resolve("log");
        Process process = new ProcessBuilder(words).redirectErrorStream(true).redirectOutput(log.toFile()).start();
        while (process.isAlive() && !Files.exists(folder.resolve("seen-stream"))) {
            Thread.sleep(10);
        }
        process.destroy();

        assertThat(process.waitFor()).isEqualTo(TERMINATED);
        assertThat(log).hasContent("natator " + name + ": interrupted");
    }
}
