package io.natator.spark;

import io.natator.process.SceneInfo;
import io.natator.process.SceneMemory;
import io.natator.protocol.SimulationRequest;
import java.nio.file.Path;

/**
 * Makes requests independent of what lies on a machine: the scene is a file that all executors have, with all that it
 * builds on and with the overrides. The state that a swim ends in is the same.
 */
final class SceneFiles {

    private final Cluster cluster;
    private final Path simulator;
    private final SceneMemory<String> names = new SceneMemory<>();

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
        return withScene(request, names.of(request.scene(), request.overrides(), () -> cluster.send("scene",
                SceneInfo.definition(request.scene(), request.overrides(), simulator))));
    }

    /** The request in the scene of that file. */
    static SimulationRequest withScene(SimulationRequest request, String file) {
        return request.withScene(file).withOverrides(null);
    }
}
