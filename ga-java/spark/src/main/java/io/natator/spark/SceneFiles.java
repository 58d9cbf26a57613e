package io.natator.spark;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.process.SceneInfo;
import io.natator.protocol.SimulationRequest;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

/**
 * Makes requests independent of what lies on a machine: the scene is a file that all executors have, with all that it
 * builds on and with the overrides. The state that a swim ends in is the same.
 */
final class SceneFiles {

    private final Cluster cluster;
    private final Path simulator;
    private final Map<List<Object>, String> names = new ConcurrentHashMap<>();

    SceneFiles(Cluster cluster, Path simulator) {
        this.cluster = cluster;
        this.simulator = simulator;
    }

    /**
     * The request with the name of such a file as its scene.
     *
     * @throws io.natator.base.InvalidInputException if the simulator does not know the scene
     */
    SimulationRequest sent(SimulationRequest request) throws InterruptedException {
        return withScene(request, file(request.scene(), request.overrides()));
    }

    private String file(String scene, JsonNode overrides) throws InterruptedException {
        List<Object> key = Arrays.asList(scene, overrides);
        String name = names.get(key);
        if (name == null) {
            name = cluster.send("scene", SceneInfo.definition(scene, overrides, simulator));
            names.put(key, name);
        }
        return name;
    }

    /** The same request in the scene of that file. */
    static SimulationRequest withScene(SimulationRequest request, String file) {
        return request.withScene(file).withOverrides(null);
    }
}
