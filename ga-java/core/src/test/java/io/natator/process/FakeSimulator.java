package io.natator.process;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.encoding.Gait;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.stream.LongStream;

/** The script {@code fake-simulator.sh}, which speaks the protocol and fails in the ways that its scenes name. */
public final class FakeSimulator {

    private FakeSimulator() {
    }

    /** Puts the script into a folder of its own, where it may leave marks. */
    public static Path in(Path folder) {
        try (InputStream source = FakeSimulator.class.getResourceAsStream("/fake-simulator.sh")) {
            return program(folder.resolve("fake-simulator.sh"), new String(source.readAllBytes(), UTF_8));
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /** A program of this text, such as a script with its first line. */
    public static Path program(Path file, String text) throws IOException {
        Files.writeString(file, text);
        assertThat(file.toFile().setExecutable(true)).isTrue();
        return file;
    }

    /** What a simulator's refusal of a request is on this side. */
    public static RequestRejectedException rejection(String reason) {
        return new RequestRejectedException(reason, true);
    }

    /** Two at a time, a process for each evaluation, which may take far longer than it can; no cache. */
    public static ExecutionSettings execution(Path folder) {
        return execution(folder, 300);
    }

    /** The same with another time limit. */
    public static ExecutionSettings execution(Path folder, double timeoutSeconds) {
        return ExecutionSettings.of(in(folder)).withMode(SimulatorMode.PROCESS).withWorkers(2)
                .withTimeout(Duration.ofMillis(Math.round(timeoutSeconds * 1000)));
    }

    /** So many requests of a scene, by the ids from 0. */
    static List<SimulationRequest> requests(int count, String scene) {
        return LongStream.range(0, count).mapToObj(id -> request(id, scene)).toList();
    }

    static SimulationRequest request(long id, String scene) {
        return new SimulationRequest(id, scene, new Gait(1.5, List.of(0.1, 0.2), List.of(0.0, 0.3)), null, null, null);
    }
}
