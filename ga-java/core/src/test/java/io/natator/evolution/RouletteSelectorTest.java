package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.Arrays;
import org.jgap.Configuration;
import org.jgap.IChromosome;
import org.jgap.InvalidConfigurationException;
import org.jgap.NaturalSelector;
import org.jgap.Population;
import org.jgap.impl.WeightedRouletteSelector;
import org.junit.jupiter.api.Test;

class RouletteSelectorTest {

    private static final double[] FITNESS = {1, 2, 3, 4, 5, 6, 7, 8, 9, 55};
    private static final int DRAWS = 100_000;
    /** Exceeded once in 1000 by a fair wheel with 9 degrees of freedom. */
    private static final double CHI_SQUARE_9_AT_0_001 = 27.88;

    private final JgapFixture jgap;

    RouletteSelectorTest() throws InvalidConfigurationException {
        jgap = new JgapFixture(20190101L, FITNESS.length);
    }

    @Test
    void drawsInProportionToFitness() throws InvalidConfigurationException {
        Population selected = new Population(jgap.configuration);
        new RouletteSelector(jgap.configuration).select(DRAWS, candidates(FITNESS), selected);

        assertThat(chiSquare(counts(selected))).isLessThan(CHI_SQUARE_9_AT_0_001);
    }

    @Test
    void neverDrawsWhatHasNoFitness() throws InvalidConfigurationException {
        Population selected = new Population(jgap.configuration);
        new RouletteSelector(jgap.configuration).select(1000, candidates(0, 1, 0, 2, 0), selected);

        int[] counts = counts(selected);
        assertThat(counts[0] + counts[2] + counts[4]).isZero();
        assertThat(counts[1]).isPositive();
    }

    @Test
    void drawsAllAlikeWhenNoneHasFitness() throws InvalidConfigurationException {
        Population selected = new Population(jgap.configuration);
        new RouletteSelector(jgap.configuration).select(30_000, candidates(0, 0, 0), selected);

        assertThat(Arrays.copyOf(counts(selected), 3)).satisfies(counts -> {
            for (int count : counts) {
                assertThat(count).isBetween(9_700, 10_300);
            }
        });
    }

    @Test
    void repeatedDrawsAreCopiesWithTheirOwnAgeAndTheSameFitness() throws InvalidConfigurationException {
        Population selected = new Population(jgap.configuration);
        new RouletteSelector(jgap.configuration).select(3, candidates(1e-9), selected);

        IChromosome[] three = selected.toChromosomes();
        assertThat(Arrays.stream(three).map(System::identityHashCode)).doesNotHaveDuplicates();
        assertThat(Arrays.stream(three).map(IChromosome::getFitnessValueDirectly)).containsOnly(1e-9);
        assertThat(Arrays.stream(three).map(IChromosome::getAge)).containsOnly(1);
        three[0].increaseAge();
        assertThat(three[1].getAge()).isEqualTo(1);
    }

    /** JGAP's wheel as the thesis used it. If this fails, the library was changed and {@code stock} is another thing. */
    @Test
    void stockWheelHardlyEverDrawsTheFittest() throws InvalidConfigurationException {
        int fittest = 0;
        int draws = 2000;
        for (int i = 0; i < draws; i++) {
            NaturalSelector stock = new WeightedRouletteSelector(jgap.configuration);
            Population selected = new Population(jgap.configuration);
            stock.select(1, candidates(FITNESS), selected);
            fittest += indexOf(selected.getChromosome(0)) == FITNESS.length - 1 ? 1 : 0;
        }

        assertThat((double) fittest / draws).as("share of draws that take the one with 55 %% of the fitness")
                .isLessThan(0.12);
    }

    /** Chromosomes whose gene tells their index. */
    private Population candidates(double... fitness) throws InvalidConfigurationException {
        Configuration configuration = jgap.configuration;
        Population population = new Population(configuration);
        for (int i = 0; i < fitness.length; i++) {
            population.addChromosome(jgap.chromosome(1, JgapFixture.LOWER + 0.1 * i, fitness[i]));
        }
        return population;
    }

    private static int indexOf(IChromosome chromosome) {
        return (int) Math.round(((double) chromosome.getGene(0).getAllele() - JgapFixture.LOWER) / 0.1);
    }

    private static int[] counts(Population selected) {
        int[] counts = new int[FITNESS.length];
        for (IChromosome chromosome : selected.toChromosomes()) {
            counts[indexOf(chromosome)]++;
        }
        return counts;
    }

    private static double chiSquare(int[] counts) {
        double total = Arrays.stream(FITNESS).sum();
        double sum = 0;
        for (int i = 0; i < counts.length; i++) {
            double expected = DRAWS * FITNESS[i] / total;
            sum += (counts[i] - expected) * (counts[i] - expected) / expected;
        }
        return sum;
    }
}
