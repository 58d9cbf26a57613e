package io.natator.process;

import io.natator.config.ExecutionSettings;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;

/**
 * Carries out evaluations, many at a time. Takes calls from several threads at once; the results depend on nothing but
 * the requests.
 */
@FunctionalInterface
public interface Evaluator extends AutoCloseable {

    /**
     * Evaluates all requests. What goes wrong in one evaluation alone (a crash, a hang, garbage) is not an exception
     * but a result with {@link SimulationResult.Status#FAILED}.
     *
     * @param requests each with an id of its own
     * @param whenDone called on the calling thread for each result as soon as it is there, in any order
     * @throws RequestRejectedException if the simulator refuses a request or cannot be started; the other evaluations
     *                                  are abandoned
     * @throws InterruptedException     if the calling thread is interrupted or this evaluator is closed; the
     *                                  evaluations are abandoned
     */
    void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException;

    /**
     * Abandons evaluations that are under way, whose callers get an {@link InterruptedException}. What wraps an evaluator closes that too, so
     * that of both only one need be closed.
     */
    @Override
    default void close() {
    }

    /**
     * Sorts the results of {@link #evaluateAll}: passes each on as soon as it and those of all requests before it are
     * there. So nothing after this point can depend on the number of workers.
     */
    static Consumer<SimulationResult> inOrder(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone) {
        Map<Long, SimulationResult> early = new HashMap<>();
        int[] next = {0};
        return result -> {
            early.put(result.id(), result);
            while (next[0] < requests.size() && early.containsKey(requests.get(next[0]).id())) {
                whenDone.accept(early.remove(requests.get(next[0]++).id()));
            }
        };
    }

    /** All results, in the order of the requests. */
    default List<SimulationResult> evaluate(List<SimulationRequest> requests) throws InterruptedException {
        List<SimulationResult> results = new ArrayList<>();
        evaluateAll(requests, inOrder(requests, results::add));
        return results;
    }

    /** Carries out one evaluation. */
    default SimulationResult evaluate(SimulationRequest request) throws InterruptedException {
        return evaluate(List.of(request)).get(0);
    }

    /**
     * The evaluator that these settings ask for.
     *
     * @param execution with a time limit
     * @throws io.natator.base.InvalidInputException if this program cannot do it, or a cluster is not to be had
     */
    static Evaluator open(ExecutionSettings execution) {
        return switch (execution.mode()) {
            case PROCESS -> new ProcessEvaluator(execution);
            case RESIDENT -> new ResidentEvaluator(execution);
            case BATCH -> new BatchEvaluator(execution);
            case SPARK -> ClusterEvaluators.open(execution);
        };
    }
}
