package io.natator.protocol;

import io.natator.protocol.SimulationResult.Instability;
import io.natator.protocol.SimulationResult.Status;

/** Results as the simulator gives them. */
public final class Results {
    private Results() {
    }

    /** A swim that got so far in 4 s. */
    public static SimulationResult ok(long id, double distance) {
        return SimulationResultBuilder.builder().id(id).status(Status.OK).distance(distance).stopped("completed")
                .simulated(4.0).frames(240).scheme("conserving").precision("float").build();
    }

    /** The same with number 0. */
    public static SimulationResult ok(double distance) {
        return ok(0, distance);
    }

    /** A swim that broke a law after half a second. */
    public static SimulationResult unstable(long id, String law) {
        return SimulationResultBuilder.builder().id(id).status(Status.UNSTABLE).stopped("unstable").simulated(0.5)
                .frames(30).scheme("flex").precision("float").unstable(new Instability(1, "frame", 0.5, law)).build();
    }
}
