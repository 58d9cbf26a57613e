package io.natator.simulator;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class SceneInfoTest {

    @TempDir
    private Path folder;

    @Test
    void tellsTheNumberOfActuators() throws InterruptedException {
        assertThat(SceneInfo.of("thesis/creature-2", FakeSimulator.execution(folder, 20)))
                .isEqualTo(new SceneInfo("thesis/creature-2", 8));
    }

    @Test
    void anUnknownSceneIsBadInput() {
        assertThatThrownBy(() -> SceneInfo.of("no/such", FakeSimulator.execution(folder, 20)))
                .isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("scene is \"no/such\"; expected a named scene or a file");
    }

    @Test
    void anAnswerWithoutActuatorsIsNotTakenForNone() throws IOException {
        Path program = Files.writeString(folder.resolve("old.sh"), "#!/bin/sh\necho '{\"scene\":\"a\"}'\n");
        assertThat(program.toFile().setExecutable(true)).isTrue();
        ExecutionSettings execution = new ExecutionSettings(program, 1, Duration.ofSeconds(20));

        assertThatThrownBy(() -> SceneInfo.of("a", execution)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("actuators");
    }
}
