package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** {@code natator evaluate}. */
class EvaluateCommandTest extends FakeSimulatorTest {

    @Test
    void evaluatesGenes() throws IOException {
        ok(natator("evaluate", "--scene", "thesis/creature-1", "--gait", "1.5", "0.1", "0.2", "0.3"));

        assertThat(Json.parse(out.toString(), JsonNode.class).get("distance").asDouble()).isEqualTo(-1.3925);
    }

    @Test
    void evaluatesAGaitFileAndTheBestOfARun() throws IOException {
        Path gait = Files.writeString(folder.resolve("gait.json"),
                "{\"$schema\":\"gait.schema.json\",\"frequency\":1.5,\"amplitude\":[0.1,0.2],\"phase\":[0,0.3]}");
        ok(natator("evaluate", "--scene", "thesis/creature-1", "--gait", gait.toString()));
        assertThat(Json.parse(out.toString(), JsonNode.class).get("distance").asDouble()).isEqualTo(-1.3925);

        ok(evolve("run"));
        JsonNode best = Json.parse(file("run", "best.json"), JsonNode.class);
        ok(natator("evaluate", "--scene", "pool/creature-1", "--gait", path("run/best.json")));
        JsonNode again = Json.parse(out.toString(), JsonNode.class);
        assertThat(again.get("distance")).isEqualTo(best.get("distance"));
        assertThat(again.get("swimming").get("reynolds").asDouble()).isEqualTo(131.4);
        assertThat(again.get("work").asDouble()).isEqualTo(0.75);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "thesis/creature-1|1.5 0.1 0.2|3 genes given; expected 4",
            "thesis/creature-1|1.5 0.1 zero 0.3|gene 3 is 'zero'; expected a number",
            "thesis/creature-1|best.json --duraton 2|Unknown option: '--duraton'",
            "thesis/creature-1|2.5 0.1 0.2 0.3|gene 1 (frequency) is 2.5; expected a number from 0.5 to 2.0",
            "thesis/creature-1|NaN 0.1 0.2 0.3|gene 1 is 'NaN'; expected a number",
            "thesis/tank|1.5 0.1 0.2 0.3|--scene is thesis/tank, where nothing can move by itself: it has no actuators",
            "thesis/creature-1|no-such.json|no-such.json does not exist",
            "fault/rejected|1.5 0.1 0.2 0.3|simulator: gait.frequency is 70"})
    void badGaitsAreNamed(String scene, String gait, String message) {
        refused(natator("evaluate --gait " + gait, "--scene", scene)).hasLineCount(1)
                .startsWith("natator evaluate: ").contains(message);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "{'frequency':'1','amplitude':[1,1],'phase':[0,0.5]}|frequency is \"1\"; expected a number",
            "{'frequency':'NaN','amplitude':[1,1],'phase':[0,0.5]}|frequency is \"NaN\"; expected a number",
            "{'frequency':1,'amplitude':[1,'1'],'phase':[0,0.5]}|amplitude[1] is \"1\"; expected a number",
            "{'frequency':1,'amplitude':[1,true],'phase':[0,0.5]}|amplitude[1] is true; expected a number",
            "{'frequency':1,'amplitude':[null,1],'phase':[0,0.5]}|amplitude[0] is null; expected a number",
            "{'gait':{'frequency':1,'amplitude':[1,1],'phase':[0,0.5],'power':null}}|power is null; expected a number",
            "{'frequency':1,'amplitude':1,'phase':[0,0.5]}|amplitude: expected a list",
            "{'frequency':1,'phase':[0,0.5]}|amplitude is missing",
            "{'amplitude':[1,1],'phase':[0,0.5]}|frequency: expected a number",
            "{'frequency':1,'amplitude':[1],'phase':[0,0.5]}|gait has 1 amplitude and 2 phases; expected as many of both",
            "{'frequency':1,'amplitude':[1,1],'phase':[0,0.5],'speed':1}|speed: unknown key; expected some of ",
            "{'description':'x','frequency':1,'amplitude':[1,1],'phase':[0,0.5]}|description: unknown key; expected some of frequency, amplitude, phase, power, offset",
            "{'gait':{'frequency':'1','speed':{}}}|speed: unknown key; expected some of ",
            "[null,1]|gait is [null,1]; expected an object with frequency, amplitude and phase",
            "{'gait':null}|gait is null; expected an object with frequency, amplitude and phase",
            "null|gait is null; expected an object with frequency, amplitude and phase"})
    void gaitFilesAreNoMoreThanGaits(String json, String message) throws IOException {
        Path gait = Files.writeString(folder.resolve("gait.json"), json.replace('\'', '"'));

        refused(natator("evaluate", "--scene", "thesis/creature-1", "--gait", gait.toString())).hasLineCount(1)
                .startsWith("natator evaluate: --gait " + gait + ": " + message).doesNotContain("line -1");
    }

    @Test
    void anEvaluationThatFailsSaysWhyAndEndsWithStatus1() throws IOException {
        assertThat(natator("evaluate", "--scene", "fault/exit", "--gait", "1.5", "0.1", "0.2", "0.3")).isEqualTo(1);

        JsonNode result = Json.parse(out.toString(), JsonNode.class);
        assertThat(result.get("status").asText()).isEqualTo("failed");
        assertThat(result.get("error").asText()).contains("out of luck");
        assertThat(err.toString()).hasLineCount(1).startsWith("natator evaluate: the simulation failed: ")
                .contains("out of luck");
    }

    @Test
    void anUnstableSimulationSaysWhenAndWhyAndEndsWithStatus1() throws IOException {
        assertThat(natator("evaluate", "--scene", "fault/unstable", "--gait", "1.5", "0.1", "0.2", "0.3")).isEqualTo(1);

        assertThat(Json.parse(out.toString(), JsonNode.class).get("status").asText()).isEqualTo("unstable");
        assertThat(err.toString()).isEqualTo(
                "natator evaluate: the simulation became unstable at 0.50 s (broke law tank), in stage frame\n");
        ok(natator("evaluate", "--help")).contains("1 unstable or failed");
    }
}
