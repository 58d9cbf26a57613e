package io.natator.cache;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.simulator.Digest;
import io.natator.simulator.Evaluator;
import io.natator.simulator.ProgramInfo;
import io.natator.simulator.SceneInfo;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.Consumer;

/**
 * Looks in a cache before it asks another evaluator, and keeps what that finds as soon as it is there, so that nothing
 * is lost when a run is killed. The results are the same to the bit.
 */
public final class CachedEvaluator implements Evaluator {

    private final Evaluator evaluator;
    private final EvaluationCache cache;
    private final Path simulator;
    private final Map<String, Object> program;
    private final Map<List<Object>, String> scenes = new ConcurrentHashMap<>();
    private final AtomicLong found = new AtomicLong();

    /**
     * Wraps an evaluator, which stays the caller's to close.
     *
     * @param execution how the evaluator works
     * @throws io.natator.config.InvalidInputException if the simulator cannot be run
     * @throws InterruptedException                    if the calling thread is interrupted
     */
    public CachedEvaluator(Evaluator evaluator, EvaluationCache cache, ExecutionSettings execution)
            throws InterruptedException {
        this.evaluator = evaluator;
        this.cache = cache;
        this.simulator = execution.simulator();
        ProgramInfo info = ProgramInfo.of(simulator);
        this.program = new HashMap<>();
        program.put("program", Digest.of(simulator));
        program.put("instructionSet", info.instructionSet());
        program.put("backend", execution.backend());
        if (execution.backend() != Backend.CPU) {
            program.put("device", info.devices().stream()
                    .filter(device -> device.startsWith(execution.device() + ":")).findFirst().orElse("none"));
        }
    }

    /** How many results came from the cache. */
    public long found() {
        return found.get();
    }

    @Override
    public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        List<SimulationRequest> missing = new ArrayList<>();
        Map<Long, String> keys = new HashMap<>();
        for (SimulationRequest request : requests) {
            String key = key(request);
            SimulationResult known = cache.find(key);
            if (known == null) {
                missing.add(request);
                keys.put(request.id(), key);
            } else {
                found.incrementAndGet();
                whenDone.accept(known.withId(request.id()));
            }
        }
        evaluator.evaluateAll(missing, result -> {
            if (result.status() == SimulationResult.Status.OK
                    || result.status() == SimulationResult.Status.UNSTABLE) {
                cache.store(keys.get(result.id()), result.withId(0));
            }
            whenDone.accept(result);
        });
    }

    /** All that determines the result: program, backend, scene, and the request but for its id. */
    private String key(SimulationRequest request) throws InterruptedException {
        Map<String, Object> key = new HashMap<>(program);
        key.put("scene", digest(request.scene(), request.overrides()));
        key.put("gait", request.gait());
        key.put("duration", request.duration());
        key.put("scheme", request.scheme());
        key.put("perturbation", request.perturbation());
        return Json.line(new TreeMap<>(key));
    }

    private String digest(String scene, JsonNode overrides) throws InterruptedException {
        List<Object> name = Arrays.asList(scene, overrides);
        String digest = scenes.get(name);
        if (digest == null) {
            digest = Digest.of(SceneInfo.definition(scene, overrides, simulator));
            scenes.put(name, digest);
        }
        return digest;
    }

    @Override
    public void close() {
        evaluator.close();
    }
}
