package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.checkpoint.Spread;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.stream.Stream;
import org.jgap.GeneticOperator;
import org.jgap.IChromosome;
import org.jgap.InvalidConfigurationException;
import org.jgap.Population;
import org.jgap.impl.GaussianMutationOperator;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class GaussianMutationTest {

    private static final int CHROMOSOMES = 500;
    private static final int GENES = 40;
    private static final double MIDDLE = 1.25;
    private static final double RANGE = JgapFixture.UPPER - JgapFixture.LOWER;

    /** Shifts of all genes as shares of the range, from the middle of the range, where no bound interferes. */
    private static List<Double> shifts(boolean stock, double deviation) throws InvalidConfigurationException {
        JgapFixture jgap = new JgapFixture(7, CHROMOSOMES);
        Population population = new Population(jgap.configuration);
        for (int i = 0; i < CHROMOSOMES; i++) {
            population.addChromosome(jgap.chromosome(GENES, MIDDLE, 1.0));
        }
        GeneticOperator operator = stock ? new GaussianMutationOperator(jgap.configuration, deviation)
                : new GaussianMutation(jgap.configuration, deviation, jgap.random);
        List<IChromosome> children = new ArrayList<>();
        operator.operate(population, children);

        assertThat(children).hasSize(CHROMOSOMES);
        return children.stream().flatMap(child -> GeneticAlgorithm.genesOf(child).stream())
                .map(value -> (value - MIDDLE) / RANGE).toList();
    }

    @ParameterizedTest
    @ValueSource(doubles = {0.02, 0.05, 0.1})
    void noiseHasMeanZeroAndTheSetDeviation(double sigma) throws InvalidConfigurationException {
        List<Double> shifts = shifts(false, sigma);

        // Four standard errors of the mean and of the deviation of 20 000 normal numbers.
        assertThat(Spread.of(shifts).mean()).isCloseTo(0.0, within(4 * sigma / Math.sqrt(shifts.size())));
        assertThat(Spread.of(shifts).sd()).isCloseTo(sigma, within(4 * sigma / Math.sqrt(2.0 * shifts.size())));
    }

    @Test
    void noiseIsNormal() throws InvalidConfigurationException {
        List<Double> shifts = shifts(false, 0.05);

        assertThat(share(shifts, 0.05)).isCloseTo(0.6827, within(0.015));
        assertThat(share(shifts, 0.10)).isCloseTo(0.9545, within(0.008));
    }

    private static double share(List<Double> shifts, double limit) {
        return (double) shifts.stream().filter(x -> Math.abs(x) <= limit).count() / shifts.size();
    }

    @Test
    void parentsStayAsTheyAre() throws InvalidConfigurationException {
        JgapFixture jgap = new JgapFixture(7, 10);
        Population population = jgap.population(10, 3);
        List<List<Double>> before = Stream.of(population.toChromosomes()).map(GeneticAlgorithm::genesOf).toList();

        new GaussianMutation(jgap.configuration, 0.1, jgap.random).operate(population, new ArrayList<>());

        assertThat(population.toChromosomes()).extracting(GeneticAlgorithm::genesOf).isEqualTo(before);
    }

    @Test
    void reflectionStaysInRange() {
        new SplittableRandom(1).doubles(500, -50, 50)
                .forEach(value -> assertThat(GaussianMutation.reflect(value, 0.5, 2.0)).isBetween(0.5, 2.0));
    }

    @Test
    void reflectsAtTheBounds() {
        assertThat(GaussianMutation.reflect(1.2, 0.5, 2.0)).isEqualTo(1.2);
        assertThat(GaussianMutation.reflect(2.25, 0.5, 2.0)).isEqualTo(1.75);
        assertThat(GaussianMutation.reflect(0.25, 0.5, 2.0)).isEqualTo(0.75);
        assertThat(GaussianMutation.reflect(3.75, 0.5, 2.0)).isEqualTo(0.75);
        assertThat(GaussianMutation.reflect(0.5, 0.5, 2.0)).isEqualTo(0.5);
        assertThat(GaussianMutation.reflect(2.0, 0.5, 2.0)).isEqualTo(2.0);
    }

    /**
     * JGAP's operator as the thesis used it: the deviation is the greatest shift, and no shift is downward. If this
     * fails, the library was changed and {@code stock} is another thing.
     */
    @ParameterizedTest
    @ValueSource(doubles = {0.05, 0.2})
    void stockNoiseIsUniformAndOnlyUpward(double deviation) throws InvalidConfigurationException {
        List<Double> shifts = shifts(true, deviation);

        assertThat(shifts).allSatisfy(shift -> assertThat(shift).isBetween(0.0, deviation));
        assertThat(Spread.of(shifts).mean()).isCloseTo(deviation / 2, within(deviation / 100));
        assertThat(share(shifts, deviation / 4)).isCloseTo(0.25, within(0.015));
    }
}
