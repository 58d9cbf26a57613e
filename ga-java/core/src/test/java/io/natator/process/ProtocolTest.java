package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.networknt.schema.JsonSchema;
import com.networknt.schema.JsonSchemaFactory;
import com.networknt.schema.SpecVersion;
import com.networknt.schema.ValidationMessage;
import io.natator.config.Json;
import io.natator.config.Scheme;
import io.natator.encoding.DenseEncoding;
import io.natator.encoding.Encoding;
import io.natator.encoding.Gait;
import io.natator.encoding.SparseEncoding;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Set;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** What this side sends and understands, against the schemas that both sides share. */
class ProtocolTest {

    private static final String GAIT = "\"gait\":{\"frequency\":1,\"amplitude\":[0.5],\"phase\":[0]}";

    @TempDir
    private Path folder;

    static Set<ValidationMessage> check(String schemaFile, String json) throws IOException {
        Path folder = Path.of(System.getProperty("natator.protocol"));
        JsonSchema validator = JsonSchemaFactory
                .getInstance(SpecVersion.VersionFlag.V202012, factory -> factory.schemaMappers(
                        ids -> ids.mapPrefix("https://natator.io/protocol/", folder.toUri().toString())))
                .getSchema(Files.readString(folder.resolve(schemaFile)));
        return validator.validate(Json.parse(json, JsonNode.class));
    }

    @Test
    void requestsFitTheSchema() throws IOException {
        JsonNode patch = Json.parse("{\"solver\":{\"substeps\":8}}", JsonNode.class);
        Encoding dense = new DenseEncoding(3);
        Encoding sparse = new SparseEncoding(8);
        List<SimulationRequest> requests = List.of(
                FakeSimulator.request(0, "thesis/creature-1"),
                new SimulationRequest(1, "scene.json", null, null, null, null),
                new SimulationRequest(5, "scene.json", null, null, null, null).withStart(7),
                new SimulationRequest(2, "a", dense.decode(List.of(2.0, 1.0, 0.0, 1.0, 1.0, 0.0)), 4.0, Scheme.FLEX,
                        patch),
                new SimulationRequest(3, "a", sparse.decode(List.of(0.5, 1.0, 0.0, 1.0)), 0.1, Scheme.CONSERVING, null),
                new SimulationRequest(4, "a", new Gait(1, List.of(0.5), List.of(0.0), 0.5, null), null, null, null));

        for (SimulationRequest request : requests) {
            assertThat(check("request.schema.json", Json.line(request))).as(Json.line(request)).isEmpty();
        }
        assertThat(check("request.schema.json", "{\"$schema\":\"request.schema.json\",\"id\":1,\"scene\":\"a\"}"))
                .isEmpty();
    }

    @ParameterizedTest
    @ValueSource(strings = {
            "{\"scene\":\"a\"," + GAIT + "}",
            "{\"id\":1," + GAIT + "}",
            "{\"id\":-1,\"scene\":\"a\"}",
            "{\"id\":1,\"scene\":\"a\",\"durations\":4}",
            "{\"id\":1,\"scene\":\"a\",\"$schema\":4}",
            "{\"id\":1,\"scene\":\"a\",\"duration\":0}",
            "{\"id\":1,\"scene\":\"a\",\"scheme\":\"FLEX\"}",
            "{\"id\":1,\"scene\":\"a\",\"gait\":{\"frequency\":61,\"amplitude\":[],\"phase\":[]}}",
            "{\"id\":1,\"scene\":\"a\",\"gait\":{\"frequency\":1,\"amplitude\":[2.1],\"phase\":[0]}}",
            "{\"id\":1,\"scene\":\"a\",\"gait\":{\"frequency\":1,\"amplitude\":[1],\"phase\":[1.5]}}",
            "{\"id\":1,\"scene\":\"a\",\"gait\":{\"frequency\":1,\"amplitude\":[1],\"phase\":[0],\"power\":5}}",
            "{\"id\":1,\"scene\":\"a\",\"gait\":{\"frequency\":\"1\",\"amplitude\":[1],\"phase\":[0]}}"})
    void theSchemaRefusesBadRequests(String request) throws IOException {
        assertThat(check("request.schema.json", request)).isNotEmpty();
    }

    @ParameterizedTest
    @ValueSource(strings = {"thesis/creature-1", "pool/creature-1", "fault/unstable", "fault/rejected"})
    void answersFitTheSchema(String scene) throws Exception {
        try (NativeProgram program = new NativeProgram(FakeSimulator.in(folder), Duration.ofMinutes(5))) {
            String answer = program.call(List.of("evaluate"),
                    Json.line(FakeSimulator.request(5, scene)) + "\n", line -> {
                    }).text();
            assertThat(check("result.schema.json", answer)).as(answer).isEmpty();
        }
    }

    @ParameterizedTest
    @ValueSource(strings = {
            "{\"id\":1}",
            "{\"id\":1,\"status\":\"ok\"}",
            "{\"id\":1,\"status\":\"error\"}",
            "{\"id\":1,\"status\":\"error\",\"error\":\"two\\nlines\"}",
            "{\"id\":1,\"status\":\"failed\",\"error\":\"x\"}",
            "{\"id\":1,\"status\":\"unstable\",\"fitness\":0,\"distance\":1,\"stopped\":\"unstable\",\"simulated\":0,"
                    + "\"frames\":0,\"scheme\":\"flex\",\"precision\":\"float\","
                    + "\"unstable\":{\"particle\":1,\"stage\":\"predict\",\"time\":0}}"})
    void theSchemaRefusesBadResults(String result) throws IOException {
        assertThat(check("result.schema.json", result)).isNotEmpty();
    }

    @Test
    void aDamagedRequestMayBeAnsweredWithoutAnId() throws IOException {
        String answer = "{\"id\":null,\"status\":\"error\",\"error\":\"not JSON\"}";

        assertThat(check("result.schema.json", answer)).isEmpty();
        assertThat(read(answer).error()).isEqualTo("not JSON");
    }

    private static SimulationResult read(String answer) throws JsonProcessingException {
        return Json.parse(answer, SimulationResult.class);
    }
}
