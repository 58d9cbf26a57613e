package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.Aggregate;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.OptimizerKind;
import io.natator.config.WeightedObjective;
import io.natator.encoding.Encoding;
import io.natator.encoding.Gait;
import io.natator.protocol.SimulationResult;
import java.util.List;
import org.junit.jupiter.api.Test;

class Nsga2Test {

    private static final Encoding ENCODING = EncodingKind.DENSE.forActuators(2);

    private static EvolutionState run(int generations, int starts) {
        return ToyEvolution.run(ToyEvolution.by(OptimizerKind.NSGA2,
                EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2).withSize(24, generations).withSeed(3)
                        .withStarts(starts, Aggregate.MEAN)))
                .end();
    }

    private static boolean dominates(Individual one, Individual other) {
        List<Double> a = one.objectives();
        List<Double> b = other.objectives();
        return a.get(0) >= b.get(0) && a.get(1) >= b.get(1) && (a.get(0) > b.get(0) || a.get(1) > b.get(1));
    }

    @Test
    void theFrontIsWhatNoOtherIsBetterThanInAll() {
        EvolutionState end = run(10, 1);
        List<Individual> front = ParetoRanking.front(end.population(), ENCODING.genes());

        assertThat(front).hasSizeGreaterThan(10);
        for (Individual one : front) {
            assertThat(end.population()).noneMatch(other -> dominates(other, one));
            Gait gait = ENCODING.decode(one.genes());
            assertThat(one.objectives()).isEqualTo(List.of(ToySimulator.distance(gait), -ToySimulator.work(gait)));
        }
        assertThat(end.population().stream()
                .filter(one -> front.stream().noneMatch(best -> best.genes().equals(one.genes()))))
                .allMatch(one -> end.population().stream().anyMatch(other -> dominates(other, one)));
        assertThat(front).isSortedAccordingTo((a, b) -> Double.compare(b.objectives().get(0), a.objectives().get(0)));
    }

    /** After some generations most of the first population are worse in both than some gait of the front. */
    @Test
    void generationsMoveTheFront() {
        List<Individual> first = run(0, 1).population();
        List<Individual> front = ParetoRanking.front(run(15, 1).population(), ENCODING.genes());

        assertThat(first.stream().filter(one -> front.stream().anyMatch(best -> dominates(best, one))))
                .hasSizeGreaterThan(20);
        // Fast ones at one end, thrifty ones at the other.
        assertThat(front.get(0).objectives().get(0)).isGreaterThan(0.45);
        assertThat(front.get(front.size() - 1).objectives().get(1)).isGreaterThan(-0.12);
    }

    /** Of several starts each objective is a mean over all runs, those in races too. */
    @Test
    void objectivesAreMeans() {
        EvolutionState end = run(4, 3);

        assertThat(end.champions()).allSatisfy(one -> {
            assertThat(one.runs()).isGreaterThan(3);
            assertThat(one.objectives().get(0)).isCloseTo(Aggregate.MEAN.of(one.estimate().runs()), within(1e-12));
            assertThat(one.objectives().get(1)).isCloseTo(-ToySimulator.work(ENCODING.decode(one.genes())),
                    within(1e-12));
        });
    }

    /** Worth by a weighted sum, for an optimizer of one objective. */
    @Test
    void weightsMakeOneObjective() {
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2).withSize(20, 5)
                .withObjectives(OptimizerKind.CMA_ES,
                        WeightedObjective.parse("forward=2,straight=0.5,work=0.1,efficiency=0.01"));
        EvolutionState end = ToyEvolution.run(settings).end();
        SimulationResult best = end.best().result();
        Gait gait = ENCODING.decode(end.best().genes());
        double distance = ToySimulator.distance(gait);
        double work = ToySimulator.work(gait);
        assertThat(best.objectives().get(0)).isEqualTo(distance);
        assertThat(best.objectives().get(1)).isCloseTo(-0.3, within(1e-12));
        assertThat(best.objectives().get(3)).isCloseTo(distance / work, within(1e-12));
        assertThat(end.best().score())
                .isCloseTo(2 * distance - 0.15 - 0.1 * work + 0.01 * distance / work, within(1e-12));
    }
}
