package io.natator.checkpoint;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.body.Swimmer;
import io.natator.config.Json;
import io.natator.verdict.Winners;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class ControlsTest {

    private static final Controls CONTROLS = Winners.controls(Winners.sample(1.0));
    private static final Swimmer WINNER = new Swimmer(Winners.GAIT, null);
    @TempDir
    private Path run;

    @BeforeEach
    void write() {
        CONTROLS.write(run);
    }

    @Test
    void thoseOfAnotherGaitAreNone() {
        assertThat(Controls.of(run, WINNER)).isEqualTo(CONTROLS);
        assertThat(Controls.of(run, WINNER.withGait(Winners.GAIT.resting()))).isNull();
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
