package io.natator.fitness;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.natator.base.InvalidInputException;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.FitnessKind;
import io.natator.config.OptimizerKind;
import io.natator.config.WeightedObjective;
import io.natator.encoding.Gait;
import io.natator.process.Evaluator;
import io.natator.process.SceneInfo;
import io.natator.protocol.GoalScore;
import io.natator.protocol.Results;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.List;
import java.util.function.Consumer;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class FitnessEvaluatorTest {

    private static final double DRIFT = 0.2;
    private static final EvolutionSettings SETTINGS = EvolutionSettings.of("goals/turn", EncodingKind.DENSE, 2);
    private static final EvolutionSettings NET = SETTINGS.withFitness(FitnessKind.NET, false);
    private static final EvolutionSettings MAP = SETTINGS.withObjectives(OptimizerKind.MAP_ELITES, null);
    private static final SimulationRequest REQUEST = SimulationRequest
            .of("goals/turn", new Gait(1, List.of(1.0, 1.0), List.of(0.0, 0.5))).withId(1);

    private static EvolutionSettings by(String objectives) {
        return SETTINGS.withObjectives(OptimizerKind.JGAP, WeightedObjective.parse(objectives));
    }

    private static SceneInfo scene(Double bodyLength, List<String> goals) {
        return new SceneInfo("goals/turn", 2, 1000, 4, 1 / 60.0, 4, 4, bodyLength, 100, goals);
    }

    /** What goes so far in water gets a score by the scene's goals, and drifts in vacuum, where there are none; the goals are another matter. */
    @ParameterizedTest
    @CsvSource({"0.5, -1, 0.3", "0.5, 0, 0.3", "0.5, 1, 0.3", "-0.5, 1, -0.5"})
    void whatGoesForwardsLosesItsDrift(double distance, double score, double net) throws InterruptedException {
        Evaluator swim = (requests, whenDone) -> requests.forEach(request -> whenDone.accept(request.overrides() == null
                ? Results.ok(request.id(), distance).withGoals(List.of(new GoalScore("turn", 1, score, null, null)))
                : Results.ok(request.id(), DRIFT)));

        assertThat(FitnessEvaluator.of(swim, NET.problem()).evaluate(REQUEST).netDistance()).isEqualTo(net);
    }

    /** A sum stays one of numbers as swims have them: a mean over starts of which one failed would else tell of that one alone. */
    @Test
    void whatFailedIsAsCrookedAsCanBe() throws InterruptedException {
        Evaluator failing = (requests, whenDone) -> requests
                .forEach(request -> whenDone.accept(SimulationResult.failed(request.id(), "no answer")));

        SimulationResult result = FitnessEvaluator.of(failing, by("forward=1,straight=0.5").problem())
                .evaluate(REQUEST);

        assertThat(result.score()).isCloseTo(-Math.PI, within(1e-9));
        assertThat(result.objectives()).containsExactly(0.0, -2 * Math.PI);
    }

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

    /** One that cannot be made closes nothing. */
    @Test
    void whatIsWrappedIsClosedOnce() {
        Counting inner = new Counting();
        for (EvolutionSettings settings : List.of(SETTINGS, NET, by("net=1,straight=0.5"), MAP)) {
            FitnessEvaluator.of(inner, settings, scene(1.0, null)).close();
        }
        assertThat(inner.closed).isEqualTo(4);

        assertThatThrownBy(() -> FitnessEvaluator.of(inner, MAP, scene(null, null)))
                .isInstanceOf(InvalidInputException.class).hasMessageContaining("the body's length is null");
        assertThatThrownBy(() -> FitnessEvaluator.of(inner, NET, scene(1.0, List.of("turn"))))
                .isInstanceOf(InvalidInputException.class).hasMessageContaining("--fitness net");
        assertThat(inner.closed).isEqualTo(4);
    }
}
