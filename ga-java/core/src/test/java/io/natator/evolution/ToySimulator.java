package io.natator.evolution;

import io.natator.encoding.Gait;
import io.natator.process.FakePool;
import io.natator.protocol.Course;
import io.natator.protocol.Results;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.SplittableRandom;
import java.util.concurrent.atomic.AtomicInteger;

/** Swims by a formula, in this process; takes an uneven time so that workers finish out of order. */
public final class ToySimulator implements FakePool.Simulation {

    static final double LUCK = 0.1;

    private final AtomicInteger calls = new AtomicInteger();

    @Override
    public SimulationResult evaluate(SimulationRequest request) throws InterruptedException {
        calls.incrementAndGet();
        if (request.id() % 5 == 0) {
            Thread.sleep(1);
        }
        double distance = isVacuum(request) ? drift(request.gait())
                : distance(request.gait()) + luck(request.gait(), request.start());
        return Results.ok(request.id(), distance).with(to -> to.scheme("flex").hash("0123456789abcdef")
                .work(work(request.gait())).course(new Course(distance, 0.1, -0.2)));
    }

    /** Best at f = 1.2, a = 0.6, φ = 0.3; negative far from there. */
    static double distance(Gait gait) {
        double distance = 0.5 - Math.pow(gait.frequency() - 1.2, 2);
        for (int i = 0; i < gait.actuators(); i++) {
            distance -= Math.pow(gait.amplitude().get(i) - 0.6, 2)
                    + (i == 0 ? 0 : Math.pow(gait.phase().get(i) - 0.3, 2));
        }
        return distance;
    }

    /** What a start adds, of standard deviation {@value #LUCK}, otherwise for each gait; nothing from the scene's own. */
    static double luck(Gait gait, Integer start) {
        return start == null ? 0 : LUCK * new SplittableRandom(31L * start + gait.hashCode()).nextGaussian();
    }

    private static boolean isVacuum(SimulationRequest request) {
        return request.overrides() != null && request.overrides().has("fluid")
                && request.overrides().get("fluid").isNull();
    }

    /** What grows with all amplitudes and the frequency. */
    static double work(Gait gait) {
        return gait.frequency() * (0.1 + gait.amplitude().stream().mapToDouble(a -> a * a).sum());
    }

    /** In vacuum: forwards above f = 1, backwards below. */
    static double drift(Gait gait) {
        return gait.frequency() - 1.0;
    }

    /** How many evaluations were asked for. */
    public int calls() {
        return calls.get();
    }
}
