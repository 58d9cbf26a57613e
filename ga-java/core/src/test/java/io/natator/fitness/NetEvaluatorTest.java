package io.natator.fitness;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.encoding.Gait;
import io.natator.process.Evaluator;
import io.natator.protocol.GoalScore;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.List;
import java.util.function.Consumer;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class NetEvaluatorTest {

    private static final double DRIFT = 0.2;

    /** Goes so far in water, where it gets this score by the scene's goals, and drifts in vacuum, where there are none. */
    private record Swim(double distance, double score) implements Evaluator {

        @Override
        public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone) {
            requests.forEach(request -> whenDone.accept(request.overrides() == null
                    ? result(request, distance).withGoals(List.of(new GoalScore("turn", 1, score, null, null))) : result(request, DRIFT)));
        }

        private static SimulationResult result(SimulationRequest request, double distance) {
            return new SimulationResult(request.id(), SimulationResult.Status.OK, distance, "completed", 4.0, 240, "conserving", "float",
                    null, null, null);
        }

        @Override
        public void close() {
            // Has nothing open.
        }
    }

    /** What the goals say of it is another matter. */
    @ParameterizedTest
    @CsvSource({"0.5, -1, 0.3", "0.5, 0, 0.3", "0.5, 1, 0.3", "-0.5, 1, -0.5"})
    void whatGoesForwardsLosesItsDrift(double distance, double score, double net) throws InterruptedException {
        SimulationRequest request = SimulationRequest.of("goals/turn", new Gait(1, List.of(1.0), List.of(0.0)));

        SimulationResult result = new NetEvaluator(new Swim(distance, score)).evaluate(request);

        assertThat(result.netDistance()).isEqualTo(net);
    }
}
