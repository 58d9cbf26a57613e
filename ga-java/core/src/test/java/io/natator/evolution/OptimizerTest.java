package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.body.Bodies;
import io.natator.body.BodyGenome;
import io.natator.config.BodyEvolution;
import io.natator.config.Budget;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.Evolved;
import io.natator.config.OperatorSet;
import io.natator.config.OptimizerKind;
import io.natator.encoding.GeneRange;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

class OptimizerTest {

    private static EvolutionSettings settings(OptimizerKind optimizer, long evaluations, long seed) {
        return ToyEvolution.by(optimizer, EvolutionSettings.of("thesis/creature-3", EncodingKind.DENSE, 5)
                .withSize(20, Budget.NO_LIMIT).withEvaluations(evaluations).withSeed(seed));
    }

    @ParameterizedTest
    @EnumSource(OptimizerKind.class)
    void takesExactlyTheEvaluationsThatItMay(OptimizerKind optimizer) {
        ToyEvolution.Recorder recorder = ToyEvolution.run(settings(optimizer, 333, 4));

        assertThat(recorder.end().evaluations()).isEqualTo(333);
        assertThat(recorder.evaluations).hasSize(333);
        assertThat(recorder.end().best().result().distance()).isEqualTo(recorder.evaluations.stream()
                .mapToDouble(one -> one.result().distance()).max().orElseThrow());
    }

    @ParameterizedTest
    @EnumSource(OptimizerKind.class)
    void continuesFromAnyGenerationAsIfNeverInterrupted(OptimizerKind optimizer) {
        EvolutionSettings settings = settings(optimizer, 250, 8);
        ToyEvolution.Recorder recorder = ToyEvolution.run(settings);
        EvolutionState whole = recorder.end();

        for (EvolutionState state : recorder.states) {
            for (long more : List.of(0L, 7L)) {
                int kept = (int) Math.min(state.evaluations() + more, recorder.evaluations.size());
                assertThat(ToyEvolution.run(settings, 2, state, recorder.evaluations.subList(0, kept)))
                        .isEqualTo(whole);
            }
        }
        assertThat(ToyEvolution.run(settings(optimizer, 250, 9)).end().population()).isNotEqualTo(whole.population());
    }

    /** The toy's optimum, 0.5, lies inside the ranges of all ten genes; a hundredth off in each gives 0.499. */
    @Test
    void cmaEsFindsTheOptimumOfASmoothFunction() {
        EvolutionState cmaEs = ToyEvolution.run(settings(OptimizerKind.CMA_ES, 3000, 1)).end();
        EvolutionState random = ToyEvolution.run(settings(OptimizerKind.RANDOM, 3000, 1)).end();

        assertThat(cmaEs.best().result().distance()).isBetween(0.4999, 0.5);
        assertThat(random.best().result().distance()).isBetween(-0.3, 0.45);
    }

    /** Once one search has converged to the last bit, the budget goes to another. */
    @Test
    void cmaEsBeginsAnewWhenItHasConverged() {
        List<EvolutionState> states = ToyEvolution.run(EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
                .withSize(10, Budget.NO_LIMIT).withEvaluations(3000L)
                .withOptimizer(OptimizerKind.CMA_ES, OperatorSet.CORRECTED, 0.05)).states;

        boolean converged = false;
        int restarts = 0;
        for (EvolutionState state : states) {
            double spread = state.history().get(state.generation()).best() - state.history().get(state.generation())
                    .worst();
            restarts += converged && spread > 0.1 ? 1 : 0;
            converged = spread < 1e-10;
        }
        assertThat(restarts).isPositive();
    }

    @ParameterizedTest
    @EnumSource(OptimizerKind.class)
    void evolvesBodiesAsItDoesGaits(OptimizerKind optimizer) {
        EvolutionSettings settings = ToyEvolution.by(optimizer,
                EvolutionSettings.of("open-water/eel", EncodingKind.SPARSE, 8)
                        .withEvolve(new BodyEvolution(Evolved.BOTH, Bodies.bundled("eel"), null)).withSize(10, 4)
                        .withSeed(3));
        ToyEvolution.Recorder recorder = ToyEvolution.run(settings);
        EvolutionState whole = recorder.end();
        EvolutionState second = recorder.states.get(1);
        int more = (int) second.evaluations() + 3;

        assertThat(ToyEvolution.run(settings, 1, second, recorder.evaluations.subList(0, more))).isEqualTo(whole);

        List<GeneRange> ranges = settings.problem().genome().genes();
        assertThat(recorder.evaluations).allSatisfy(one -> GeneRange.check(ranges, one.genes()));
        assertThat(whole.best().genes()).hasSize(4 + new BodyGenome(Bodies.bundled("eel")).genes().size());
    }
}
