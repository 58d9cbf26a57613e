package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.jgap.Configuration;
import org.jgap.FitnessFunction;
import org.jgap.Gene;
import org.jgap.IChromosome;
import org.jgap.InvalidConfigurationException;
import org.jgap.Population;
import org.jgap.impl.GABreeder;

/**
 * One generation of the thesis' algorithm (2.6). JGAP's own breeder differs in that it mistakes children for unchanged
 * parents whenever fewer were selected than the population's size, and evaluates one chromosome after another.
 */
@SuppressWarnings("serial") // JGAP makes breeders serializable; checkpoints hold plain data instead.
final class ThesisBreeder extends GABreeder {

    private final transient EvolutionSettings settings;
    private final transient GenerationEvaluator evaluator;
    /** The chromosomes of the current population, by their genes. */
    private final transient Map<List<Double>, Individual> known = new HashMap<>();

    ThesisBreeder(EvolutionSettings settings, GenerationEvaluator evaluator) {
        this.settings = settings;
        this.evaluator = evaluator;
    }

    /** From evaluated parents to the next evaluated population. */
    @Override
    public Population evolve(Population parents, Configuration configuration) {
        Population selected = select(parents, configuration);
        Population children = alter(selected, configuration);
        return evaluate(combine(selected, children), configuration);
    }

    /** The best (30 of 150), the rest (120) by roulette. */
    private Population select(Population parents, Configuration configuration) {
        try {
            Population selected = new Population(configuration, settings.search().population());
            Operators.elite(configuration).select(settings.search().elites(), parents, selected);
            Operators.roulette(settings, configuration)
                    .select(settings.search().population() - selected.size(), parents, selected);
            return selected;
        } catch (InvalidConfigurationException e) {
            throw new IllegalStateException(e);
        }
    }

    /** New chromosomes by crossover, mutation and Gaussian mutation of the selected, which stay as they are. */
    private Population alter(Population selected, Configuration configuration) {
        try {
            Population all = new Population(configuration, selected.toChromosomes());
            applyGeneticOperators(configuration, all);
            IChromosome[] chromosomes = all.toChromosomes();
            Population children = new Population(configuration, chromosomes.length);
            for (int i = selected.size(); i < chromosomes.length; i++) {
                children.addChromosome(chromosomes[i]);
            }
            return children;
        } catch (InvalidConfigurationException e) {
            throw new IllegalStateException(e);
        }
    }

    /** All go on: the selected a generation older, the children newborn and without their parents' fitness. */
    private static Population combine(Population selected, Population children) {
        for (IChromosome survivor : selected.toChromosomes()) {
            survivor.increaseAge();
        }
        for (IChromosome child : children.toChromosomes()) {
            child.resetAge();
            child.setFitnessValueDirectly(FitnessFunction.NO_FITNESS_VALUE);
        }
        selected.addChromosomes(children);
        return selected;
    }

    /**
     * Gives every chromosome its fitness. All whose genes are not those of a known chromosome are simulated, as one
     * batch and each once; a child that crossover or mutation left unchanged is not.
     *
     * @return the population without what could no more be simulated, since the run has had its evaluations
     */
    Population evaluate(Population population, Configuration configuration) {
        Set<List<Double>> present = new LinkedHashSet<>();
        for (IChromosome chromosome : population.toChromosomes()) {
            present.add(genesOf(chromosome));
        }
        List<List<Double>> unknown = new ArrayList<>(present);
        unknown.removeIf(known::containsKey);
        know(evaluator.evaluate(unknown));
        known.keySet().retainAll(present);
        try {
            Population evaluated = new Population(configuration, population.size());
            for (IChromosome chromosome : population.toChromosomes()) {
                if (known.containsKey(genesOf(chromosome))) {
                    chromosome.setFitnessValueDirectly(evaluated(chromosome).fitness());
                    evaluated.addChromosome(chromosome);
                }
            }
            return evaluated;
        } catch (InvalidConfigurationException e) {
            throw new IllegalStateException(e);
        }
    }

    /** Declares chromosomes that are evaluated. */
    void know(List<Individual> individuals) {
        individuals.forEach(individual -> known.put(individual.genes(), individual));
    }

    /**
     * What came of a chromosome's evaluation.
     *
     * @throws IllegalStateException if it was not evaluated
     */
    Individual evaluated(IChromosome chromosome) {
        Individual found = known.get(genesOf(chromosome));
        if (found == null) {
            throw new IllegalStateException("chromosome has not been evaluated: " + chromosome);
        }
        return found;
    }

    static List<Double> genesOf(IChromosome chromosome) {
        List<Double> genes = new ArrayList<>();
        for (Gene gene : chromosome.getGenes()) {
            genes.add((Double) gene.getAllele());
        }
        return List.copyOf(genes);
    }
}
