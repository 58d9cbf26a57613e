package io.natator.fitness;

import io.natator.process.Evaluator;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.VacuumRequests;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;

/**
 * Measures, beside each distance swum forwards, what the same gait drifts in vacuum in the same time. What swims
 * backwards is not measured there: it has no distance to take a drift off. What is unstable in vacuum is unstable.
 */
public final class NetEvaluator implements Evaluator {

    private final Evaluator evaluator;

    /** Wraps an evaluator, which is closed with this one. */
    public NetEvaluator(Evaluator evaluator) {
        this.evaluator = evaluator;
    }

    @Override
    public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        Map<Long, SimulationRequest> asked = new HashMap<>();
        requests.forEach(request -> asked.put(request.id(), request));
        Map<Long, SimulationResult> inWater = new HashMap<>();
        List<SimulationRequest> inVacuum = new ArrayList<>();
        evaluator.evaluateAll(requests, result -> {
            if (result.distanceOrZero() > 0) {
                inWater.put(result.id(), result);
                inVacuum.add(VacuumRequests.of(asked.get(result.id()), result.simulated()));
            } else {
                whenDone.accept(result);
            }
        });
        evaluator.evaluateAll(inVacuum, vacuum -> whenDone.accept(combine(inWater.get(vacuum.id()), vacuum)));
    }

    private static SimulationResult combine(SimulationResult water, SimulationResult vacuum) {
        if (vacuum.status() == SimulationResult.Status.OK) {
            return water.withVacuumDrift(vacuum.distance());
        }
        if (vacuum.status() == SimulationResult.Status.UNSTABLE) {
            // No drift is known to take off, so the distance is worth nothing.
            return vacuum.withId(water.id()).withError("in vacuum: " + vacuum.whyUnstable());
        }
        return SimulationResult.failed(water.id(), "in vacuum: " + vacuum.error());
    }

    @Override
    public void close() {
        evaluator.close();
    }
}
