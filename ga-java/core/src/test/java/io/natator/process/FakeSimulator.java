package io.natator.process;

import io.natator.config.ExecutionSettings;
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

/** The script {@code fake-simulator.sh}, which speaks the protocol and fails in the ways that its scenes name. */
public final class FakeSimulator {

    private FakeSimulator() {
    }

    /** Puts the script into a folder of its own, where it may leave marks. */
    public static Path in(Path folder) {
        Path script = folder.resolve("fake-simulator.sh");
        try (InputStream source = FakeSimulator.class.getResourceAsStream("/fake-simulator.sh")) {
            Files.copy(source, script);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        if (!script.toFile().setExecutable(true)) {
            throw new IllegalStateException(script + " cannot be made executable");
        }
        return script;
    }

    /** What a simulator's refusal of a request is on this side. */
    public static RequestRejectedException rejection(String reason) {
        return new RequestRejectedException(reason, true);
    }

    static ExecutionSettings execution(Path folder, double timeoutSeconds) {
        return new ExecutionSettings(in(folder), 2, Duration.ofMillis(Math.round(timeoutSeconds * 1000)));
    }

    static SimulationRequest request(long id, String scene) {
        return new SimulationRequest(id, scene, new Gait(1.5, List.of(0.1, 0.2), List.of(0.0, 0.3)), null, null, null);
    }
}
