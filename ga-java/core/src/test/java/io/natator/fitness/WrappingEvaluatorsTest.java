package io.natator.fitness;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.base.InvalidInputException;
import io.natator.config.WeightedObjective;
import io.natator.process.Evaluator;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.List;
import java.util.function.Consumer;
import org.junit.jupiter.api.Test;

/** Closing an evaluator that wraps another closes that, as each says; one that cannot be made closes nothing. */
class WrappingEvaluatorsTest {

    private static final class Counting implements Evaluator {
        private int closed;

        @Override
        public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone) {
            throw new IllegalStateException("for closing only");
        }

        @Override
        public void close() {
            closed++;
        }
    }

    @Test
    void whatIsWrappedIsClosedOnce() {
        Counting inner = new Counting();
        new NetEvaluator(inner).close();
        assertThat(inner.closed).isEqualTo(1);
        new ObjectiveEvaluator(inner, WeightedObjective.parse("net=1,straight=0.5")).close();
        assertThat(inner.closed).isEqualTo(2);
        EffortEvaluator.of(new NetEvaluator(inner), 1.0).close();
        assertThat(inner.closed).isEqualTo(3);
    }

    @Test
    void whatCannotBeMadeClosesNothing() {
        Counting inner = new Counting();
        assertThatThrownBy(() -> EffortEvaluator.of(inner, null)).isInstanceOf(InvalidInputException.class);
        assertThat(inner.closed).isZero();
    }
}
