package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.encoding.GeneRange;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.atomic.AtomicLong;
import java.util.stream.Stream;
import org.jgap.Chromosome;
import org.jgap.Configuration;
import org.jgap.DefaultFitnessEvaluator;
import org.jgap.FitnessFunction;
import org.jgap.Gene;
import org.jgap.GeneticOperator;
import org.jgap.IChromosome;
import org.jgap.InvalidConfigurationException;
import org.jgap.Population;
import org.jgap.event.EventManager;
import org.jgap.impl.DoubleGene;
import org.jgap.impl.StockRandomGenerator;

/**
 * The genetic algorithm of thesis 2.6 on JGAP. Between generations it keeps nothing: each is bred from the individuals
 * handed in, with random numbers that depend on the seed and the number of the generation only. So a run can continue
 * from any generation whose individuals were kept.
 *
 * <p>To be used by one thread; JGAP keeps part of a configuration in system properties named after thread and id.
 */
final class GeneticAlgorithm implements Optimizer {

    private static final AtomicLong RUNS = new AtomicLong();

    private final EvolutionSettings settings;
    private final List<GeneRange> ranges;
    private final ThesisBreeder breeder;
    private final StockRandomGenerator random = new StockRandomGenerator();
    private final Configuration configuration;
    /** The chromosomes of the generation, in their order. */
    private List<IChromosome> bred = List.of();
    /** Those of them that are evaluated, and their parents, by their genes. */
    private final Map<List<Double>, Individual> known = new HashMap<>();

    GeneticAlgorithm(EvolutionSettings settings, List<GeneRange> ranges) {
        this.settings = settings;
        this.ranges = ranges;
        this.breeder = new ThesisBreeder(settings);
        this.configuration = new Configuration("natator-" + RUNS.incrementAndGet(), null);
        try {
            configure();
        } catch (InvalidConfigurationException e) {
            throw new IllegalStateException(e);
        }
    }

    private void configure() throws InvalidConfigurationException {
        configuration.setBreeder(breeder);
        configuration.setRandomGenerator(random);
        configuration.setEventManager(new EventManager());
        configuration.setFitnessEvaluator(new DefaultFitnessEvaluator());
        configuration.setFitnessFunction(new KnownFitness(known));
        configuration.setPopulationSize(settings.search().population());
        configuration.setKeepPopulationSizeConstant(false);
        configuration.setSampleChromosome(chromosome(ranges.stream().map(GeneRange::lower).toList()));
        configuration.addNaturalSelector(Operators.elite(configuration), true);
        for (GeneticOperator operator : Operators.alterers(settings, configuration, random)) {
            configuration.addGeneticOperator(operator);
        }
        configuration.lockSettings();
    }

    /** The distinct genomes of the children, without those that equal a parent. */
    @Override
    public List<List<Double>> propose(int generation, List<Individual> parents) {
        random.setSeed(Seeds.of(settings.search().seed(), generation));
        known.clear();
        know(parents);
        try {
            bred = List.of((generation == 0 ? first() : children(parents)).toChromosomes());
        } catch (InvalidConfigurationException e) {
            throw new IllegalStateException(e);
        }
        Set<List<Double>> unknown = new LinkedHashSet<>();
        bred.forEach(chromosome -> unknown.add(genesOf(chromosome)));
        unknown.removeAll(known.keySet());
        return List.copyOf(unknown);
    }

    /** All chromosomes, without what could no more be simulated, since the run has had its evaluations. */
    @Override
    public List<Individual> population(List<Individual> newborns) {
        know(newborns);
        List<Individual> individuals = new ArrayList<>();
        for (IChromosome chromosome : bred) {
            Individual evaluated = known.get(genesOf(chromosome));
            if (evaluated != null) {
                individuals.add(evaluated.withAge(chromosome.getAge()));
            }
        }
        return individuals;
    }

    private void know(List<Individual> individuals) {
        individuals.forEach(individual -> known.put(individual.genes(), individual));
    }

    /** Random chromosomes. */
    private Population first() throws InvalidConfigurationException {
        Population population = new Population(configuration, settings.search().population());
        for (int i = 0; i < settings.search().population(); i++) {
            IChromosome chromosome = Chromosome.randomInitialChromosome(configuration);
            chromosome.increaseAge();
            population.addChromosome(chromosome);
        }
        return population;
    }

    private Population children(List<Individual> parents) throws InvalidConfigurationException {
        Population population = new Population(configuration, parents.size());
        for (Individual parent : parents) {
            IChromosome chromosome = chromosome(parent.genes());
            chromosome.setAge(parent.age());
            chromosome.setFitnessValueDirectly(parent.fitness());
            population.addChromosome(chromosome);
        }
        return breeder.evolve(population, configuration);
    }

    private IChromosome chromosome(List<Double> values) throws InvalidConfigurationException {
        Gene[] genes = new Gene[ranges.size()];
        for (int i = 0; i < genes.length; i++) {
            genes[i] = new DoubleGene(configuration, ranges.get(i).lower(), ranges.get(i).upper());
            genes[i].setAllele(values.get(i));
        }
        return new Chromosome(configuration, genes);
    }

    static List<Double> genesOf(IChromosome chromosome) {
        return Stream.of(chromosome.getGenes()).map(gene -> (Double) gene.getAllele()).toList();
    }

    @Override
    public void close() {
        Configuration.reset(configuration.getId());
    }

    /** What JGAP asks for a fitness that it does not have: only those of evaluated chromosomes exist. */
    @SuppressWarnings("serial") // JGAP makes fitness functions serializable; this one never is serialized.
    private static final class KnownFitness extends FitnessFunction {

        private final transient Map<List<Double>, Individual> known;

        KnownFitness(Map<List<Double>, Individual> known) {
            this.known = known;
        }

        @Override
        protected double evaluate(IChromosome chromosome) {
            return known.get(genesOf(chromosome)).fitness();
        }
    }
}
