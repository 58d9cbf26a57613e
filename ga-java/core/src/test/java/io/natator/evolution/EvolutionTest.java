package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.OperatorSet;
import io.natator.config.OptimizerKind;
import io.natator.config.WeightedObjective;
import io.natator.process.FakePool;
import io.natator.protocol.Results;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

class EvolutionTest {

    private static EvolutionSettings settings(OperatorSet operators, int population, int generations, long seed) {
        return EvolutionSettings.of("thesis/creature-3", EncodingKind.DENSE, 5).withSize(population, generations)
                .withSeed(seed).withOptimizer(OptimizerKind.JGAP, operators, 0.05);
    }

    @ParameterizedTest
    @EnumSource(OperatorSet.class)
    void improvesAndNeverLosesItsBest(OperatorSet operators) {
        EvolutionState end = ToyEvolution.run(settings(operators, 40, 25, 3)).end();

        double before = Double.NEGATIVE_INFINITY;
        for (GenerationSummary generation : end.history()) {
            assertThat(generation.best()).isGreaterThanOrEqualTo(before);
            before = generation.best();
        }
        assertThat(end.history()).hasSize(26);
        assertThat(before).isGreaterThan(end.history().get(0).best() + 0.1);
        assertThat(end.best().result().distance()).isEqualTo(before);
        assertThat(ToySimulator.distance(EncodingKind.DENSE.forActuators(5).decode(end.best().genes())))
                .isEqualTo(before);
    }

    @ParameterizedTest
    @EnumSource(OperatorSet.class)
    void sameSeedSameRunWhateverTheWorkers(OperatorSet operators) {
        EvolutionState one = ToyEvolution.run(settings(operators, 30, 6, 42), 1, null, List.of());
        EvolutionState four = ToyEvolution.run(settings(operators, 30, 6, 42), 4, null, List.of());
        EvolutionState other = ToyEvolution.run(settings(operators, 30, 6, 43), 4, null, List.of());

        assertThat(four).isEqualTo(one);
        assertThat(other.population()).isNotEqualTo(one.population());
    }

    @Test
    void thesisSizeTakesTheExpectedNumberOfEvaluations() {
        ToySimulator simulator = new ToySimulator();
        EvolutionState end = ToyEvolution.run(settings(OperatorSet.CORRECTED, 150, 3, 1), simulator);

        assertThat(end.history().get(0).evaluations()).isEqualTo(150);
        assertThat(simulator.calls()).isEqualTo((int) end.evaluations());
        for (GenerationSummary generation : end.history().subList(1, 4)) {
            // 150 by Gaussian mutation, up to 104 by crossover, about 150·(1 − 0.96^10) = 50 by mutation.
            assertThat(generation.evaluations()).isBetween(250, 310);
            assertThat(generation.population()).isBetween(150 + 290, 150 + 320);
        }
    }

    @Test
    void simulatesNoGenomeTwiceWhileItLives() {
        List<EvaluationRecord> evaluations = new ArrayList<>();
        Set<List<Double>> previous = new HashSet<>();
        List<EvaluationRecord> repeated = new ArrayList<>();
        ToyEvolution.run(settings(OperatorSet.CORRECTED, 30, 10, 5), new ToySimulator(), new EvolutionListener() {
            @Override
            public void evaluated(EvaluationRecord evaluation) {
                evaluations.add(evaluation);
                if (previous.contains(evaluation.genes())) {
                    repeated.add(evaluation);
                }
            }

            @Override
            public void generationFinished(EvolutionState state) {
                previous.clear();
                state.population().forEach(individual -> previous.add(individual.genes()));
            }
        });

        assertThat(repeated).isEmpty();
        assertThat(evaluations).extracting(one -> one.result().id()).isSorted().doesNotHaveDuplicates();
    }

    @Test
    void theSelectedGoOnUnchangedAndAge() {
        List<EvolutionState> states = ToyEvolution.run(settings(OperatorSet.CORRECTED, 50, 1, 5)).states;

        List<Individual> first = states.get(0).population();
        List<Individual> second = states.get(1).population();
        assertThat(first).hasSize(50).extracting(Individual::age).containsOnly(1);
        List<List<Double>> firstGenes = first.stream().map(Individual::genes).toList();
        assertThat(second.subList(0, 50)).extracting(Individual::age).containsOnly(2);
        assertThat(second.subList(0, 50)).allSatisfy(one -> assertThat(firstGenes).contains(one.genes()));
        assertThat(second.subList(50, second.size())).extracting(Individual::age).containsOnly(0);
        List<Double> tenBest = first.stream().map(Individual::fitness).sorted(Comparator.reverseOrder())
                .limit(10).toList();
        assertThat(second.subList(0, 10)).extracting(Individual::fitness).isEqualTo(tenBest);
        assertThat(tenBest.get(0)).isPositive();
    }

    /** Where work has a price all may lose by swimming: the best go on all the same. */
    @Test
    void theBestGoOnWhereAllScoresAreNegative() {
        EvolutionSettings dear = settings(OperatorSet.CORRECTED, 50, 3, 5)
                .withObjectives(OptimizerKind.JGAP, WeightedObjective.parse("distance=1,work=10"));
        List<EvolutionState> states = ToyEvolution.run(dear).states;

        List<Double> first = scores(states.get(0));
        assertThat(first.get(0)).isNegative();
        assertThat(scores(states.get(1)).subList(0, 10)).zipSatisfy(first.subList(0, 10),
                (next, before) -> assertThat(next).isGreaterThanOrEqualTo(before));
        assertThat(scores(states.get(3)).get(0)).isGreaterThan(first.get(0));
    }

    private static List<Double> scores(EvolutionState state) {
        return state.population().stream().map(Individual::score).sorted(Comparator.reverseOrder()).toList();
    }

    /** Backward swimmers have fitness 0 for JGAP, and their distance in the record. */
    @Test
    void negativeDistancesAreKeptInTheRecord() {
        EvolutionState end = ToyEvolution.run(settings(OperatorSet.CORRECTED, 10, 2, 5),
                request -> Results.ok(request.id(), -0.25));

        assertThat(end.best().result().distance()).isEqualTo(-0.25);
        assertThat(end.history()).extracting(GenerationSummary::mean)
                .allSatisfy(mean -> assertThat(mean).isCloseTo(-0.25, within(1e-12)));
    }

    @Test
    void oneFailureCostsOneEvaluation() {
        FakePool.Simulation flaky = request -> request.id() % 4 == 1
                ? SimulationResult.failed(request.id(), "crashed") : Results.ok(request.id(), 0.1);
        EvolutionState end = ToyEvolution.run(settings(OperatorSet.CORRECTED, 16, 2, 5), flaky);

        assertThat(end.history().get(0).failed()).isEqualTo(4);
        assertThat(end.history().get(0).worst()).isZero();
        assertThat(end.best().result().distance()).isEqualTo(0.1);
    }

    @Test
    void stopsWhenMostEvaluationsFail() {
        FakePool.Simulation broken = request -> SimulationResult.failed(request.id(), "exit status 1");

        assertThatThrownBy(() -> ToyEvolution.run(settings(OperatorSet.CORRECTED, 10, 2, 5), broken))
                .isInstanceOf(EvolutionFailedException.class)
                .hasMessage("generation 0: 10 of 10 simulations failed, the first: exit status 1");
    }
}
