package io.natator.checkpoint;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.body.Swimmer;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class ConvergenceTest {

    private static final Gait GAIT = new Gait(2, List.of(0.1), List.of(0.0));

    @TempDir
    private Path run;

    @Test
    void thatOfAnotherSwimmerIsNone() throws IOException {
        JsonNode body = Json.parse("{\"creature\":\"eel\"}", JsonNode.class);
        Swimmer winner = new Swimmer(GAIT, body);
        Convergence written = Convergence.write(run, winner, Json.parse("{\"levels\":[]}", JsonNode.class));

        assertThat(Convergence.of(run, winner)).isEqualTo(written);
        assertThat(Convergence.of(run, winner.withGait(GAIT.resting()))).isNull();
        assertThat(Convergence.of(run, new Swimmer(GAIT, null))).isNull();
    }

    @Test
    void whatIsDamagedIsNone() throws IOException {
        Files.writeString(run.resolve("converge.json"), "{");

        assertThat(Convergence.of(run, new Swimmer(GAIT, null))).isNull();
    }
}
