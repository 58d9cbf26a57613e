package io.natator.evolution;

import java.util.concurrent.atomic.AtomicLong;
import org.jgap.Chromosome;
import org.jgap.Configuration;
import org.jgap.DefaultFitnessEvaluator;
import org.jgap.Gene;
import org.jgap.IChromosome;
import org.jgap.InvalidConfigurationException;
import org.jgap.Population;
import org.jgap.impl.DoubleGene;
import org.jgap.impl.StockRandomGenerator;

/** A JGAP configuration with a seed, and chromosomes for it. */
final class JgapFixture {

    static final double LOWER = 0.5;
    static final double UPPER = 2.0;
    private static final AtomicLong NUMBER = new AtomicLong();

    final StockRandomGenerator random = new StockRandomGenerator();
    final Configuration configuration = new Configuration("test-" + NUMBER.incrementAndGet(), null);

    JgapFixture(long seed, int populationSize) throws InvalidConfigurationException {
        random.setSeed(seed);
        configuration.setRandomGenerator(random);
        configuration.setFitnessEvaluator(new DefaultFitnessEvaluator());
        configuration.setPopulationSize(populationSize);
    }

    /** A chromosome with age 1, all of whose genes have this value within [0.5, 2]. */
    IChromosome chromosome(int genes, double value, double fitness) throws InvalidConfigurationException {
        Gene[] all = new Gene[genes];
        for (int i = 0; i < genes; i++) {
            all[i] = new DoubleGene(configuration, LOWER, UPPER);
            all[i].setAllele(value);
        }
        IChromosome chromosome = new Chromosome(configuration, all);
        chromosome.setFitnessValueDirectly(fitness);
        chromosome.setAge(1);
        return chromosome;
    }

    /** Chromosomes of which no two share a gene value. */
    Population population(int size, int genes) throws InvalidConfigurationException {
        Population population = new Population(configuration, size);
        for (int i = 0; i < size; i++) {
            population.addChromosome(chromosome(genes, LOWER + (UPPER - LOWER) * (i + 0.5) / size, 1.0));
        }
        return population;
    }
}
