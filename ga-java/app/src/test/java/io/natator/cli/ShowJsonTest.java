package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

/** What {@code natator show --json} tells of a winner that does not swim: its report is made of it. */
class ShowJsonTest extends CommandTest {

    private Path run;

    /** A tenth of a second is not enough to get anywhere. */
    @BeforeEach
    void evolve() {
        run = folder.resolve("run");
        ok(natator("evolve --scene pool/creature-1 --population 4 --generations 1 --duration 0.1 --output-dir",
                run.toString()));
    }

    private JsonNode shown() throws IOException {
        ok(natator("show", "--json", run.toString()));
        return Json.parse(out.toString(), JsonNode.class);
    }

    private static List<String> outcomes(JsonNode shown) {
        List<String> outcomes = new ArrayList<>();
        shown.get("measures").forEach(row -> outcomes.add(row.get(0).textValue() + ": " + row.get(3).textValue()));
        return outcomes;
    }

    private static String answer(JsonNode shown) {
        List<String> sentences = new ArrayList<>();
        shown.get("answer").forEach(one -> sentences.add(one.textValue()));
        return String.join(" ", sentences);
    }

    @Test
    void ofAWinnerThatGetsNowhereByAllItsControls() throws IOException {
        ok(natator("check", "--starts", "2", run.toString()));

        JsonNode shown = shown();

        assertThat(shown.get("title").textValue()).isEqualTo("pool/creature-1, seed 1");
        assertThat(shown.get("unfinished").isNull()).isTrue();
        assertThat(answer(shown)).startsWith("The best gait does not swim: moves ").doesNotContain("NaN", "null")
                .containsSubsequence("By its controls it does not swim: ", "ork of the muscles ",
                        "To go on: try more --generations");
        assertThat(outcomes(shown)).hasSize(6).contains("way, 4 fresh starts: does not", "resting muscles: does not",
                "share of the body under water: holds").noneMatch(outcome -> outcome.endsWith("not measured"));
        assertThat(shown.get("numbers"))
                .anySatisfy(row -> assertThat(row.get(0).textValue()).isEqualTo("frequency (1/s)"));
        assertThat(shown.at("/request/scene").textValue()).isEqualTo("pool/creature-1");
        assertThat(shown.get("generations")).hasSize(2);
    }

    @Test
    void ofAWinnerThatFellApart() throws IOException {
        Path file = run.resolve("best.json");
        ObjectNode best = (ObjectNode) Json.parse(Files.readString(file), JsonNode.class);
        best.remove(List.of("fresh", "vacuum"));
        best.put("distance", 0).put("speed", 0).set("result",
                Json.parse("{\"id\":3,\"status\":\"unstable\",\"stopped\":\"unstable\","
                        + "\"distance\":null,\"simulated\":0.05,\"frames\":3,\"scheme\":\"conserving\",\"precision\":\"float\","
                        + "\"unstable\":{\"particle\":7,\"stage\":\"frame\",\"time\":0.05,\"law\":\"shape\"}}",
                        JsonNode.class));
        Files.writeString(file, Json.document(best));

        JsonNode shown = shown();

        assertThat(answer(shown)).startsWith("The best gait is not judged: unstable at 0.05 s (broke law shape)")
                .doesNotContain("NaN", "null").contains("natator check " + run + " runs them");
        assertThat(outcomes(shown)).containsExactly("way, one run: does not", "half the time step: not measured",
                "without water: not measured",
                "resting muscles: not measured", "mirrored: not measured");
    }
}
