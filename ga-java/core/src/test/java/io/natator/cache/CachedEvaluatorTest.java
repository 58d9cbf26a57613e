package io.natator.cache;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.config.Scheme;
import io.natator.encoding.Gait;
import io.natator.evolution.ToySimulator;
import io.natator.process.Evaluator;
import io.natator.process.FakePool;
import io.natator.process.FakeSimulator;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class CachedEvaluatorTest {

    private static final Gait GAIT = new Gait(1.5, List.of(0.1, 0.2), List.of(0.0, 0.3));

    @TempDir
    private Path folder;
    private ExecutionSettings execution;

    @BeforeEach
    void fake() {
        execution = FakeSimulator.execution(folder);
    }

    /** How many of the requests the simulator is asked for. */
    private int simulated(ExecutionSettings settings, SimulationRequest... requests) throws InterruptedException {
        ToySimulator simulator = new ToySimulator();
        try (Evaluator inner = new FakePool(simulator, 2);
                CachedEvaluator cached = new CachedEvaluator(inner, new EvaluationCache(folder.resolve("cache")),
                        settings)) {
            for (SimulationRequest request : requests) {
                SimulationResult result = cached.evaluate(request);
                assertThat(result.id()).isEqualTo(request.id());
            }
            assertThat(cached.found()).isEqualTo(requests.length - simulator.calls());
        }
        return simulator.calls();
    }

    @Test
    void theIdDoesNotMatterAndAllElseDoes() throws InterruptedException, IOException {
        JsonNode patch = Json.parse("{\"solver\":{\"substeps\":8}}", JsonNode.class);
        List<SimulationRequest> different = List.of(
                new SimulationRequest(1, "thesis/creature-1", GAIT, null, null, null),
                new SimulationRequest(2, "thesis/creature-2", GAIT, null, null, null),
                new SimulationRequest(3, "thesis/creature-1", new Gait(Math.nextUp(1.5), GAIT.amplitude(),
                        GAIT.phase()), null, null, null),
                new SimulationRequest(4, "thesis/creature-1", GAIT, 2.0, null, null),
                new SimulationRequest(5, "thesis/creature-1", GAIT, null, Scheme.CONSERVING, null),
                new SimulationRequest(6, "thesis/creature-1", GAIT, null, null, patch),
                new SimulationRequest(7, "thesis/creature-1", GAIT, null, null, null, 1),
                new SimulationRequest(8, "thesis/creature-1", GAIT, null, null, null, 2));

        SimulationRequest[] all = different.toArray(SimulationRequest[]::new);
        assertThat(simulated(execution, all)).isEqualTo(8);
        assertThat(simulated(execution, all)).isZero();
        assertThat(simulated(execution, all[0].withId(99L))).isZero();
        assertThat(simulated(execution.withBackend(Backend.AUTO), all)).isEqualTo(8);
        Files.writeString(execution.simulator(), "# another build\n", StandardOpenOption.APPEND);
        assertThat(simulated(execution, all)).isEqualTo(8);
    }

    @Test
    void failuresAreNotKept() throws InterruptedException {
        FakePool.Simulation failing = request -> SimulationResult.failed(request.id(), "crashed");
        SimulationRequest request = new SimulationRequest(1, "thesis/creature-1", GAIT, null, null, null);
        try (Evaluator inner = new FakePool(failing, 1);
                CachedEvaluator cached = new CachedEvaluator(inner,
                        new EvaluationCache(folder.resolve("cache")), execution)) {
            cached.evaluate(request);
        }

        assertThat(simulated(execution, request)).isEqualTo(1);
    }
}
