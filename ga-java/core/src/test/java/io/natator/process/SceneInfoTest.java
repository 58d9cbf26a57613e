package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.base.InvalidInputException;
import io.natator.protocol.RefusedSceneException;
import io.natator.protocol.RequestRejectedException;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class SceneInfoTest {

    @TempDir
    private Path folder;

    /** As the simulator of today puts it. */
    @Test
    void aRefusalNamesTheSceneOnce() {
        for (String said : List.of("scene \"pool/eel\": solver.substeps = -3: must be a whole number",
                "unknown scene \"pool/eel\"")) {
            assertThat(failure(2, "natator-sim: " + said)).isInstanceOf(RefusedSceneException.class).hasMessage(said);
        }
        assertThat(failure(2, "natator-sim: file \"eel.json\": not valid JSON"))
                .isInstanceOf(RefusedSceneException.class)
                .hasMessage("scene pool/eel: file \"eel.json\": not valid JSON");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "7||simulator ended with exit status 7", "1|natator-sim: disk full|disk full",
            "2|sim: 1: \u007fELF: not found|simulator ended with exit status 2, errors \"sim: 1: \ufffdELF: not found\""})
    void whatIsNoRefusalIsNoBadInput(int status, String errors, String reason) {
        assertThat(failure(status, errors == null ? "" : errors))
                .isInstanceOfSatisfying(RequestRejectedException.class, e -> assertThat(e.isBadInput()).isFalse())
                .hasMessage("scene pool/eel: " + reason);
    }

    /** What it told of its progress is no reason. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "2;natator-sim: converge: base: run 1 of 2;natator-sim: disk full|disk full",
            "2;natator-sim: converge: base: run 1 of 2;level substeps;natator-sim: gait: unknown;see --help|gait: unknown / see --help",
            "134;natator-sim: converge: base: run 1 of 2;terminate called|simulator ended with exit status 134"})
    void theReasonIsTheLastThatTheProgramSays(String lines, String reason) {
        String[] said = lines.split(";", 2);

        assertThat(failure(Integer.parseInt(said[0]), said[1].replace(";", ErrorTail.LINE_END)).getMessage()
                .replace(" | ", " / ")).startsWith("scene pool/eel: " + reason)
                .matches(message -> said[0].equals("134") || message.endsWith(reason));
    }

    private static RuntimeException failure(int status, String errors) {
        return new NativeProgram.Output(status, "", errors).failure("scene pool/eel");
    }

    @Test
    void tellsTheNumberOfActuators() throws InterruptedException {
        assertThat(SceneInfo.of("thesis/creature-2", null, FakeSimulator.in(folder)))
                .isEqualTo(new SceneInfo("thesis/creature-2", 8, 5950, 4.0, 1.0 / 60, 4, 4, 1.2, 142, null));
    }

    @Test
    void anUnknownSceneIsBadInput() {
        assertThatThrownBy(() -> SceneInfo.of("no/such", null, FakeSimulator.in(folder)))
                .isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("scene is \"no/such\"; expected a named scene or a file");
    }

    @Test
    void anAnswerWithoutActuatorsIsNotTakenForNone() throws IOException {
        Path program = FakeSimulator.program(folder.resolve("old.sh"), "#!/bin/sh\necho '{\"scene\":\"a\"}'\n");

        assertThatThrownBy(() -> SceneInfo.of("a", null, program)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("actuators");
    }
}
