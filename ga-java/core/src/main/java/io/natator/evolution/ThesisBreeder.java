package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import org.jgap.Configuration;
import org.jgap.FitnessFunction;
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

    ThesisBreeder(EvolutionSettings settings) {
        this.settings = settings;
    }

    /** From evaluated parents to the next population, whose children are to be evaluated. */
    @Override
    public Population evolve(Population parents, Configuration configuration) {
        Population selected = select(parents, configuration);
        Population children = alter(selected, configuration);
        return combine(selected, children);
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
}
