package io.natator.simulator;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class SceneInfoTest {

    @TempDir
    private Path folder;

    /** As the simulator of today puts it. */
    @Test
    void aRefusalNamesTheSceneOnce() {
        for (String said : List.of("scene \"pool/eel\": solver.substeps = -3: must be a whole number", "unknown scene \"pool/eel\"")) {
            assertThat(new NativeProgram.Output(2, "", "natator-sim: " + said).failure("scene pool/eel")).isEqualTo(said);
        }
        assertThat(new NativeProgram.Output(2, "", "natator-sim: file \"eel.json\": not valid JSON").failure("scene pool/eel"))
                .isEqualTo("scene pool/eel: file \"eel.json\": not valid JSON");
        assertThat(new NativeProgram.Output(7, "", "").failure("itself")).isEqualTo("itself: simulator ended with exit status 7");
    }

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
