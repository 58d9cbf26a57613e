package io.natator.stream;

import static io.natator.process.Processes.assertThatNoChildIsLeft;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.base.InvalidInputException;
import io.natator.config.Scheme;
import io.natator.process.FakeSimulator;
import io.natator.protocol.RequestRejectedException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The life of the program; what it says is a file. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class StreamProcessTest {

    private static final StreamOptions OPTIONS = StreamOptions.live("test/pool", null, null, false);

    @TempDir
    private Path folder;

    @AfterEach
    void nothingRunsOn() throws InterruptedException {
        assertThatNoChildIsLeft();
    }

    /** A program that says these bytes and then does what the lines of shell say. */
    private Path program(StreamBytes stream, String then) throws IOException {
        Files.write(folder.resolve("said"), stream.toBytes());
        return FakeSimulator.program(folder.resolve("program.sh"), "#!/bin/sh\ncd '" + folder
                + "'\necho \"$@\" > arguments\ncat said\n" + then + "\n");
    }

    private static StreamBytes scene() {
        return new StreamBytes().json("SCEN", StreamBytes.scene());
    }

    @Test
    void messagesComeInOrderAndTheEndIsNull() throws IOException, InterruptedException {
        StreamBytes stream = scene().frame(1, 0).frame(1, 1).json("STOP", "{\"reason\":\"until\"}");
        try (StreamProcess process = new StreamProcess(program(stream, "exit 0"), OPTIONS)) {
            assertThat(process.next()).isInstanceOf(StreamMessage.Scene.class);
            assertThat(((StreamMessage.Frame) process.next()).decode().frame()).isZero();
            assertThat(((StreamMessage.Frame) process.next()).decode().frame()).isOne();
            assertThat(((StreamMessage.Stop) process.next()).isEnd()).isTrue();
            assertThat(process.next()).isNull();
        }
    }

    @Test
    void commandsArriveOneALine() throws IOException, InterruptedException {
        Path script = program(scene(), "read first; read second; echo \"$first\" \"$second\" >heard; "
                + "printf 'ANSW\\023\\0\\0\\0'; printf '{\"id\":1,\"ok\":true} '; sleep 3600");
        try (StreamProcess process = new StreamProcess(script, OPTIONS)) {
            process.next();
            process.grant(2);
            process.send("{\"do\":\"run\"}");

            assertThatThrownBy(process::next).hasMessageStartingWith("ANSW of 19 bytes");
            assertThat(folder.resolve("heard")).hasContent("{\"do\":\"credit\",\"frames\":2} {\"do\":\"run\"}");
            assertThatThrownBy(() -> process.send("{}\n{}")).isInstanceOf(IllegalArgumentException.class);
        }
    }

    @Test
    void optionsBecomeArguments() throws IOException, InterruptedException {
        StreamOptions options = StreamOptions.recording("a b", StreamBytes.scene().get("definition"),
                StreamBytes.scene().get("gait"), 0.5).with(Scheme.CONSERVING, "double")
                .withFields(List.of(StreamField.DENSITY, StreamField.POSITION));
        try (StreamProcess process = new StreamProcess(program(scene(), "exit 0"), options)) {
            process.next();
        }
        assertThat(folder.resolve("arguments")).hasContent("stream a b --overrides {\"name\":\"pool\"} --gait "
                + "{\"frequency\":1,\"amplitude\":[0.5],\"phase\":[0]} --scheme conserving --precision double "
                + "--fields position,density --rate 0.0 --until 0.5 --lossless");
    }

    @Test
    void aRefusalIsBadInputInTheProgramsWords() throws IOException, InterruptedException {
        Path script = program(new StreamBytes(), "echo 'scene x: not known' >&2; exit 2");
        try (StreamProcess process = new StreamProcess(script, OPTIONS)) {
            assertThatThrownBy(process::next).isInstanceOf(InvalidInputException.class)
                    .hasMessage("scene x: not known");
        }
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "echo out of luck >&2; exit 1 | simulator ended; exit status 1, errors \"out of luck\"",
            "printf F; kill -9 $$         | stream ended 1 byte into the 8-byte head of a message; exit status 137",
            "exec >&-; sleep 3600         | simulator closed its output, but runs on"})
    void aProgramThatEndsIsToldOf(String end, String message) throws IOException, InterruptedException {
        try (StreamProcess process = new StreamProcess(program(scene(), end), OPTIONS)) {
            process.next();
            assertThatThrownBy(process::next).isInstanceOf(StreamException.class).hasMessageStartingWith(message);
        }
    }

    @Test
    void closingEndsAWaitAndAllDescendants() throws IOException, InterruptedException, ExecutionException,
            TimeoutException {
        StreamProcess process = new StreamProcess(program(scene(), "sleep 3600 & sleep 3600"), OPTIONS);
        process.next();
        CompletableFuture<StreamMessage> next = CompletableFuture.supplyAsync(() -> {
            try {
                return process.next();
            } catch (IOException e) {
                throw new IllegalStateException(e);
            }
        });
        process.close();

        assertThat(next.get()).isNull();
    }

    /** As is what is started while the descendants are being counted, if by chance. */
    @Test
    void closingEndsWhatIsNobodysChildAnyMore() throws IOException, InterruptedException {
        String unlike = "3600." + ProcessHandle.current().pid();
        StreamProcess process = new StreamProcess(program(scene(), "(sleep " + unlike + " &); sleep 3600"), OPTIONS);
        process.next();
        while (alive("sleep " + unlike) == 0) {
            Thread.sleep(10);
        }
        process.close();

        assertThat(alive("sleep " + unlike)).isZero();
        assertThat(process.next()).isNull();
    }

    private static long alive(String command) {
        return ProcessHandle.allProcesses()
                .filter(other -> other.isAlive() && other.info().commandLine().orElse("").endsWith(command)).count();
    }

    @Test
    void aProgramThatReadsNoCommandsCostsNoMemory() throws IOException, InterruptedException {
        String command = "{\"do\":\"" + "x".repeat(1000) + "\"}";
        try (StreamProcess process = new StreamProcess(program(scene(), "sleep 3600"), OPTIONS)) {
            process.next();
            assertThatThrownBy(() -> {
                for (int i = 0; i < 10 * StreamProcess.QUEUED_COMMANDS; i++) {
                    process.send(command);
                }
            }).isInstanceOf(StreamException.class).hasMessage("simulator has left 1024 commands unread");
        }
    }

    @Test
    void aProgramThatCannotStartIsToldOf() {
        assertThatThrownBy(() -> new StreamProcess(folder.resolve("none"), OPTIONS))
                .isInstanceOf(RequestRejectedException.class).hasMessageStartingWith("cannot start ");
    }
}
