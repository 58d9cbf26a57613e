package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.protocol.ResultReader;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Status;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** What the real simulator says, against the schema and the reader on this side. */
class RealProtocolTest {

    private static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize();

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "OK|thesis/creature-1|{}",
            "OK|thesis/creature-1-vacuum|{\"solver\":{\"substeps\":2}}",
            "UNSTABLE|thesis/creature-1|{\"solver\":{\"relaxationMode\":\"global\"}}",
            "ERROR|thesis/creature-1|{\"timeStep\":-1}",
            "ERROR|no/such/scene|{}"})
    void answersFitTheSchema(Status status, String scene, String overrides) throws Exception {
        assertThat(SIMULATOR).as("built by: cmake --preset release && cmake --build --preset release").isExecutable();
        SimulationRequest request = new SimulationRequest(9, scene, FakeSimulator.request(9, scene).gait(), 0.1, null,
                Json.parse(overrides, JsonNode.class));

        String answer;
        try (NativeProgram program = new NativeProgram(SIMULATOR, Duration.ofMinutes(5))) {
            answer = program.call(List.of("evaluate"), Json.line(request) + "\n", line -> {
            }).text();
        }

        assertThat(ProtocolTest.check("result.schema.json", answer)).as(answer).isEmpty();
        SimulationResult result = Json.parse(answer, SimulationResult.class);
        assertThat(result.status()).as(answer).isEqualTo(status);
        assertThat(result.id()).isEqualTo(9);
        assertThat(answer.lines()).hasSize(1);
    }

    /** The simulator knows the numbers of starts, and tells where the body went. */
    @Test
    void anotherStartIsAnotherSwim() throws Exception {
        SimulationRequest request = new SimulationRequest(9, "pool/creature-1",
                FakeSimulator.request(9, "pool/creature-1").gait(), 0.1, null, null);
        List<SimulationResult> results = new ArrayList<>();
        for (Integer start : Arrays.asList(3, 4, 3, null)) {
            try (NativeProgram program = new NativeProgram(SIMULATOR, Duration.ofMinutes(5))) {
                results.add(ResultReader.read(
                        program.call(List.of("evaluate"), Json.line(request.withStart(start)) + "\n", line -> {
                        }).text()));
            }
        }

        assertThat(results.get(2)).isEqualTo(results.get(0));
        assertThat(results.stream().map(SimulationResult::hash).distinct()).hasSize(3);
        assertThat(results.get(0).course().forward()).isCloseTo(results.get(0).distance(), within(0.01));
        assertThat(results.get(0).work()).isNotNull();
    }

    /** The control of every swim: a tank that goes along, or has no ends, is taken away with its water. */
    @ParameterizedTest
    @ValueSource(strings = {"endless/eel", "goals/hold", "company/school", "pool/eel"})
    void anySceneCanBeSwumInVacuum(String scene) throws Exception {
        List<Double> eight = Collections.nCopies(8, 0.5);
        SimulationRequest swim = new SimulationRequest(9, scene, new Gait(2, eight, eight), 0.2, null, null);
        try (NativeProgram program = new NativeProgram(SIMULATOR, Duration.ofMinutes(5))) {
            String answer = program.call(List.of("evaluate"), Json.line(swim.inVacuum(0.2)) + "\n", line -> {
            }).text();
            assertThat(ResultReader.read(answer).distance()).as(answer).isCloseTo(0, within(1e-4));
        }
    }
}
