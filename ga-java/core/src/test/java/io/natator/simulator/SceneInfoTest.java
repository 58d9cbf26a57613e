package io.natator.simulator;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class SceneInfoTest {

    @TempDir
    private Path folder;

    @Test
    void tellsTheNumberOfActuators() throws InterruptedException {
        assertThat(SceneInfo.of("thesis/creature-2", null, FakeSimulator.in(folder)))
                .isEqualTo(new SceneInfo("thesis/creature-2", 8, 5950, 4.0, 0.0166, 4, 4, 1.2, 142));
    }

    @Test
    void anUnknownSceneIsBadInput() {
        assertThatThrownBy(() -> SceneInfo.of("no/such", null, FakeSimulator.in(folder)))
                .isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("scene is \"no/such\"; expected a named scene or a file");
    }

    @Test
    void anAnswerWithoutActuatorsIsNotTakenForNone() throws IOException {
        Path program = Files.writeString(folder.resolve("old.sh"), "#!/bin/sh\necho '{\"scene\":\"a\"}'\n");
        assertThat(program.toFile().setExecutable(true)).isTrue();

        assertThatThrownBy(() -> SceneInfo.of("a", null, program)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("actuators");
    }
}
