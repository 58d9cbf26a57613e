package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.stream.DoubleStream;
import java.util.stream.Stream;
import org.jgap.Gene;
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
    private static double[] shifts(boolean stock, double deviation) throws InvalidConfigurationException {
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
        return children.stream().flatMapToDouble(child -> DoubleStream.of(valuesOf(child)))
                .map(value -> (value - MIDDLE) / RANGE).toArray();
    }

    private static double[] valuesOf(IChromosome chromosome) {
        double[] values = new double[chromosome.size()];
        for (int i = 0; i < values.length; i++) {
            Gene gene = chromosome.getGene(i);
            values[i] = (double) gene.getAllele();
        }
        return values;
    }

    private static double mean(double[] values) {
        return DoubleStream.of(values).average().orElseThrow();
    }

    private static double deviation(double[] values) {
        double mean = mean(values);
        return Math.sqrt(DoubleStream.of(values).map(x -> (x - mean) * (x - mean)).average().orElseThrow());
    }

    @ParameterizedTest
    @ValueSource(doubles = {0.02, 0.05, 0.1})
    void noiseHasMeanZeroAndTheSetDeviation(double sigma) throws InvalidConfigurationException {
        double[] shifts = shifts(false, sigma);

        // Four standard errors of the mean and of the deviation of 20 000 normal numbers.
        assertThat(mean(shifts)).isCloseTo(0.0, within(4 * sigma / Math.sqrt(shifts.length)));
        assertThat(deviation(shifts)).isCloseTo(sigma, within(4 * sigma / Math.sqrt(2.0 * shifts.length)));
    }

    @Test
    void noiseIsNormal() throws InvalidConfigurationException {
        double[] shifts = shifts(false, 0.05);

        assertThat(share(shifts, 0.05)).isCloseTo(0.6827, within(0.015));
        assertThat(share(shifts, 0.10)).isCloseTo(0.9545, within(0.008));
    }

    private static double share(double[] shifts, double limit) {
        return (double) DoubleStream.of(shifts).filter(x -> Math.abs(x) <= limit).count() / shifts.length;
    }

    @Test
    void parentsStayAsTheyAre() throws InvalidConfigurationException {
        JgapFixture jgap = new JgapFixture(7, 10);
        Population population = jgap.population(10, 3);
        List<double[]> before = Stream.of(population.toChromosomes()).map(GaussianMutationTest::valuesOf).toList();

        new GaussianMutation(jgap.configuration, 0.1, jgap.random).operate(population, new ArrayList<>());

        for (int i = 0; i < before.size(); i++) {
            assertThat(valuesOf(population.getChromosome(i))).containsExactly(before.get(i));
        }
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
        double[] shifts = shifts(true, deviation);

        assertThat(DoubleStream.of(shifts).min().orElseThrow()).isGreaterThanOrEqualTo(0.0);
        assertThat(DoubleStream.of(shifts).max().orElseThrow()).isLessThanOrEqualTo(deviation);
        assertThat(mean(shifts)).isCloseTo(deviation / 2, within(deviation / 100));
        assertThat(share(shifts, deviation / 4)).isCloseTo(0.25, within(0.015));
    }
}
