package io.natator.fitness;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.WeightedObjective;
import io.natator.encoding.Gait;
import io.natator.process.Evaluator;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.List;
import java.util.function.Consumer;
import org.junit.jupiter.api.Test;

class ObjectiveEvaluatorTest {

    /** A sum stays one of numbers as swims have them: a mean over starts of which one failed would else tell of that one alone. */
    @Test
    void whatFailedIsAsCrookedAsCanBe() throws InterruptedException {
        Evaluator failing = new Evaluator() {
            @Override
            public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone) {
                requests.forEach(request -> whenDone.accept(SimulationResult.failed(request.id(), "no answer")));
            }

            @Override
            public void close() {
                // Has nothing open.
            }
        };
        SimulationRequest request = SimulationRequest.of("pool/creature-1", new Gait(1, List.of(1.0, 1.0), List.of(0.0, 0.5))).withId(1);

        SimulationResult result = new ObjectiveEvaluator(failing, WeightedObjective.parse("forward=1,straight=0.5")).evaluate(request);

        assertThat(result.score()).isCloseTo(-Math.PI, within(1e-9));
        assertThat(result.objectives()).containsExactly(0.0, -2 * Math.PI);
    }
}
