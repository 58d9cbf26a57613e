package io.natator.fitness;

import io.natator.base.InvalidInputException;
import io.natator.process.Evaluator;
import io.natator.protocol.Effort;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;
import java.util.function.ToDoubleFunction;

/** Tells of each result what its swim took. */
public final class EffortEvaluator implements Evaluator {

    private final Evaluator evaluator;
    private final ToDoubleFunction<SimulationRequest> bodyLength;

    /**
     * Wraps an evaluator of one body, which is closed with this one.
     *
     * @param bodyLength of the creature in scene units
     * @throws InvalidInputException if that is not known
     */
    public static EffortEvaluator of(Evaluator evaluator, Double bodyLength) {
        if (bodyLength == null || !(bodyLength > 0)) {
            throw new InvalidInputException("optimizer map-elites: the body's length is " + bodyLength
                    + "; expected a simulator that tells it, and a scene with a body");
        }
        return new EffortEvaluator(evaluator, request -> bodyLength);
    }

    /**
     * Wraps an evaluator of several bodies, which is closed with this one.
     *
     * @param bodyLength of a request's creature in scene units
     */
    public EffortEvaluator(Evaluator evaluator, ToDoubleFunction<SimulationRequest> bodyLength) {
        this.evaluator = evaluator;
        this.bodyLength = bodyLength;
    }

    @Override
    public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        Map<Long, SimulationRequest> asked = new HashMap<>();
        requests.forEach(request -> asked.put(request.id(), request));
        evaluator.evaluateAll(requests, result -> whenDone.accept(result.status() == SimulationResult.Status.OK
                ? result.withEffort(effort(result, asked.get(result.id()))) : result));
    }

    private Effort effort(SimulationResult result, SimulationRequest request) {
        if (result.work() == null) {
            throw new InvalidInputException("optimizer map-elites: this simulator does not measure the muscles' work in scheme "
                    + result.scheme() + ", by which kinds of gaits are told apart; expected --scheme conserving or lattice");
        }
        return new Effort(request.gait().frequency() * result.simulated(),
                result.distance() / bodyLength.applyAsDouble(request), result.distance(), result.work());
    }

    @Override
    public void close() {
        evaluator.close();
    }
}
