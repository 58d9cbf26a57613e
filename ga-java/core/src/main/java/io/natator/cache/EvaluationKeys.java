package io.natator.cache;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.Sha256;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.process.ProgramInfo;
import io.natator.process.SceneInfo;
import io.natator.process.SceneMemory;
import io.natator.protocol.SimulationRequest;
import java.nio.file.Path;
import java.util.Map;
import java.util.TreeMap;

/** Puts on one line all that determines the result of a request: program, backend, scene, and the request itself. */
final class EvaluationKeys {

    private final Path simulator;
    private final Map<String, Object> program = new TreeMap<>();
    /** Digests of scenes. */
    private final SceneMemory<String> scenes = new SceneMemory<>();

    EvaluationKeys(ExecutionSettings execution) throws InterruptedException {
        simulator = execution.simulator();
        ProgramInfo info = ProgramInfo.of(simulator);
        program.put("program", Sha256.of(simulator));
        program.put("instructionSet", info.instructionSet());
        program.put("backend", execution.backend());
        if (execution.backend() != Backend.CPU) {
            program.put("device", info.device(execution.device()).orElse("none"));
        }
    }

    /** The key of a request, in which its id has no part. */
    String of(SimulationRequest request) throws InterruptedException {
        Map<String, Object> key = new TreeMap<>(program);
        key.put("scene", digest(request.scene(), request.overrides()));
        key.put("gait", request.gait());
        key.put("duration", request.duration());
        key.put("scheme", request.scheme());
        if (request.start() != null) {
            key.put("start", request.start());
        }
        return Json.line(key);
    }

    private String digest(String scene, JsonNode overrides) throws InterruptedException {
        return scenes.of(scene, overrides, () -> Sha256.of(SceneInfo.definition(scene, overrides, simulator)));
    }
}
