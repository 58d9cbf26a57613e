package fish;

import io.natator.Natator;
import io.natator.encoding.Gait;
import io.natator.protocol.SimulationRequest;
import java.util.List;

/** Swims half a second. */
public final class Fish {

    private Fish() {
    }

    /** Prints how it ended and the distance. */
    public static void main(String[] arguments) throws InterruptedException {
        Natator natator = new Natator(Natator.onThisMachine().withWorkers(1));
        Gait gait = new Gait(1.861, List.of(0.973, 0.69), List.of(0.0, 0.648));
        var swim = natator.evaluate(SimulationRequest.of("pool/creature-1", gait).withDuration(0.5));
        System.out.println("swim: " + swim.status() + " " + swim.distance());
    }
}
