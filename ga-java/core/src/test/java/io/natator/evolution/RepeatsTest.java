package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.Aggregate;
import io.natator.config.Budget;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.OptimizerKind;
import io.natator.encoding.Gait;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** Evolutions in which every gait is run from several starts. */
class RepeatsTest {

    private static final int STARTS = 4;

    private static EvolutionSettings settings(OptimizerKind optimizer, int generations) {
        return ToyEvolution.by(optimizer, EvolutionSettings.of("thesis/creature-3", EncodingKind.DENSE, 5)
                .withSize(20, generations).withSeed(6).withStarts(STARTS, Aggregate.MEAN));
    }

    private static double truth(Individual one) {
        Gait gait = EncodingKind.DENSE.forActuators(5).decode(one.genes());
        return ToySimulator.distance(gait);
    }

    @ParameterizedTest
    @EnumSource(OptimizerKind.class)
    void continuesFromAnyEvaluationAsIfNeverInterrupted(OptimizerKind optimizer) {
        EvolutionSettings settings = settings(optimizer, 4);
        ToyEvolution.Recorder recorder = ToyEvolution.run(settings);
        EvolutionState whole = recorder.end();
        assertThat(ToyEvolution.run(settings, 1, null, List.of())).isEqualTo(whole);

        for (int kept = 0; kept <= recorder.evaluations.size(); kept += 17) {
            EvolutionState from = null;
            for (EvolutionState state : recorder.states) {
                from = state.evaluations() <= kept ? state : from;
            }
            assertThat(ToyEvolution.run(settings, 2, from, recorder.evaluations.subList(0, kept))).as("after %d", kept)
                    .isEqualTo(whole);
        }
        assertThat(ToyEvolution.run(settings.withSeed(7)).end().champions()).isNotEqualTo(whole.champions());
    }

    @ParameterizedTest
    @EnumSource(OptimizerKind.class)
    void newbornsOfAGenerationShareTheirStarts(OptimizerKind optimizer) {
        ToyEvolution.Recorder recorder = ToyEvolution.run(settings(optimizer, 3));

        Set<Integer> earlier = new HashSet<>();
        for (int generation = 0; generation <= 3; generation++) {
            List<EvaluationRecord> own = recorder.of(generation);
            assertThat(own).hasSize(recorder.announced.get(generation));
            Set<Integer> first = own.subList(0, STARTS).stream().map(EvaluationRecord::start)
                    .collect(Collectors.toSet());
            assertThat(first).hasSize(STARTS);
            Map<List<Double>, Set<Integer>> newborns = own.stream().filter(one -> first.contains(one.start()))
                    .collect(Collectors.groupingBy(EvaluationRecord::genes,
                            Collectors.mapping(EvaluationRecord::start, Collectors.toSet())));
            assertThat(newborns).hasSizeGreaterThanOrEqualTo(20);
            assertThat(newborns.values()).containsOnly(first);
            own.stream().map(EvaluationRecord::start).distinct()
                    .forEach(start -> assertThat(earlier).doesNotContain(start));
            own.forEach(one -> earlier.add(one.start()));
        }
    }

    @ParameterizedTest
    @EnumSource(OptimizerKind.class)
    void theBestAreRunAgainInEveryGeneration(OptimizerKind optimizer) {
        ToyEvolution.Recorder recorder = ToyEvolution.run(settings(optimizer, 5));
        EvolutionState end = recorder.end();

        for (EvolutionState state : recorder.states) {
            assertThat(state.champions()).hasSize(4)
                    .isSortedAccordingTo((a, b) -> Double.compare(b.score(), a.score()));
            assertThat(state.champions()).contains(state.best());
            assertThat(state.best().runs()).isGreaterThan(STARTS);
        }
        for (Individual champion : end.champions()) {
            List<EvaluationRecord> own = recorder.evaluations.stream()
                    .filter(one -> one.genes().equals(champion.genes())).toList();
            assertThat(own).extracting(EvaluationRecord::start).doesNotHaveDuplicates().hasSize(champion.runs());
            assertThat(champion.score()).isEqualTo(
                    Aggregate.MEAN.of(own.stream().map(one -> one.result().score()).toList()));
        }
        assertThat(end.evaluations()).isEqualTo(recorder.evaluations.size());
    }

    /** The best of many single runs is the luckiest; what several runs say of the winner holds. */
    @Test
    void theWinnerIsNoLuckyDraw() {
        double lost = 0;
        double luckiest = 0;
        for (long seed = 1; seed <= 8; seed++) {
            ToyEvolution.Recorder recorder = ToyEvolution.run(settings(OptimizerKind.JGAP, 6).withSeed(seed));
            Individual best = recorder.end().best();
            lost += (best.score() - truth(best)) / 8;
            EvaluationRecord single = recorder.evaluations.stream().reduce(
                    (a, b) -> b.result().score() > a.result().score() ? b : a).orElseThrow();
            luckiest += (single.result().score() - ToySimulator.distance(single.gait())) / 8;
        }
        assertThat(luckiest).isGreaterThan(1.5 * ToySimulator.LUCK);
        assertThat(lost).isBetween(-0.4 * ToySimulator.LUCK, 0.6 * ToySimulator.LUCK);
    }

    /** Survivors bring their runs along; the next parents are chosen by all of them. */
    @Test
    void parentsAreChosenByTheirMeans() {
        List<EvolutionState> states = ToyEvolution.run(EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
                .withSize(20, 1).withStarts(STARTS, Aggregate.MEAN)).states;

        List<List<Double>> best = states.get(0).population().stream()
                .sorted((a, b) -> Double.compare(b.score(), a.score())).limit(4).map(Individual::genes).toList();
        assertThat(states.get(1).population().subList(0, 4)).extracting(Individual::genes).isEqualTo(best);
        assertThat(states.get(0).population().stream().filter(one -> best.contains(one.genes())))
                .allMatch(one -> one.score() > 0 && one.runs() > STARTS);
    }

    @ParameterizedTest
    @EnumSource(OptimizerKind.class)
    void takesExactlyTheEvaluationsThatItMay(OptimizerKind optimizer) {
        for (long most : List.of(4L, 7L, 81L, 90L, 97L, 98L, 203L)) {
            ToyEvolution.Recorder recorder = ToyEvolution
                    .run(settings(optimizer, Budget.NO_LIMIT).withEvaluations(most));
            assertThat(recorder.end().evaluations()).isEqualTo(most).isEqualTo(recorder.evaluations.size());
            assertThat(recorder.end().best()).isNotNull();
        }
        assertThatThrownBy(() -> settings(optimizer, 1).withEvaluations(3L))
                .hasMessage("evaluations is 3; expected at least the 4 starts of one gait");
    }

    /** A gait that wins by one lucky run of four is not the best by its lower quartile. */
    @Test
    void theJudgeHasItsSay() {
        EvolutionSettings mean = settings(OptimizerKind.RANDOM, 2);
        EvolutionState byMean = ToyEvolution.run(mean).end();
        EvolutionState byQuartile = ToyEvolution.run(mean.withStarts(STARTS, Aggregate.LOWER_QUARTILE)).end();

        assertThat(byQuartile.champions()).allSatisfy(
                one -> assertThat(one.score()).isEqualTo(Aggregate.LOWER_QUARTILE.of(one.estimate().runs())));
        assertThat(byQuartile.history().get(0).mean()).isLessThan(byMean.history().get(0).mean());
    }

    @Test
    void freshStartsAreThoseOfNoGeneration() {
        for (int number = 0; number < 1000; number++) {
            assertThat(Seeds.freshStart(number, number)).isGreaterThanOrEqualTo(1 << 30);
            assertThat(Seeds.start(number, number, number)).isBetween(0, (1 << 30) - 1);
        }
    }
}
