package io.natator.checkpoint;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.body.Swimmer;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.protocol.SimulationResult;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class ControlsTest {

    private static final Gait GAIT = new Gait(2, List.of(0.1), List.of(0.0));
    private static final SwimSample SAMPLE = SwimSample
            .of(List.of(new SimulationResult(0L, SimulationResult.Status.OK, 1.0, "completed", 4.0,
                    240, "conserving", "float", null, null, null, null, null, null)), 4, GAIT, 4.0, null);
    private static final Controls CONTROLS = new Controls(GAIT, null, "conserving", 4.0, null, SAMPLE, SAMPLE, SAMPLE,
            null, SAMPLE, SAMPLE,
            null, null, null);
    private static final Swimmer WINNER = new Swimmer(GAIT, null);
    @TempDir
    private Path run;

    @BeforeEach
    void write() {
        CONTROLS.write(run);
    }

    @Test
    void thoseOfAnotherGaitAreNone() {
        assertThat(Controls.of(run, WINNER)).isEqualTo(CONTROLS);
        assertThat(Controls.of(run, WINNER.withGait(GAIT.resting()))).isNull();
    }

    @ParameterizedTest
    @ValueSource(strings = {"gait", "water", "resting", "vacuum", "halfStep", "mirrored"})
    void thoseThatLackAKeyAreNone(String key) throws IOException {
        Path file = run.resolve("check.json");
        ObjectNode content = Json.read(file, ObjectNode.class, "check");
        content.remove(key);
        Files.writeString(file, Json.document(content));

        assertThat(Controls.of(run, WINNER)).isNull();
    }
}
