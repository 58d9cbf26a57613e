package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.config.OperatorSet;
import java.util.List;
import org.jgap.Configuration;
import org.jgap.GeneticOperator;
import org.jgap.InvalidConfigurationException;
import org.jgap.NaturalSelector;
import org.jgap.impl.BestChromosomesSelector;
import org.jgap.impl.CrossoverOperator;
import org.jgap.impl.GaussianMutationOperator;
import org.jgap.impl.MutationOperator;
import org.jgap.impl.StockRandomGenerator;
import org.jgap.impl.WeightedRouletteSelector;

/** The genetic operators of thesis 2.6, corrected or as JGAP ships them. */
final class Operators {

    /** Pairs crossed, as a share of the population. */
    static final double CROSSOVER_SHARE = 0.35;
    /** One gene of 25, that is 4 %, is mutated. */
    static final int MUTATION_DENOMINATOR = 25;

    private Operators() {
    }

    /** The operators that make new chromosomes, in the order in which they work. */
    static List<GeneticOperator> alterers(EvolutionSettings settings, Configuration configuration,
            StockRandomGenerator random) throws InvalidConfigurationException {
        boolean stock = settings.search().operators() == OperatorSet.STOCK;
        double deviation = settings.search().gaussianDeviation();
        return List.of(
                stock ? new CrossoverOperator(configuration, CROSSOVER_SHARE)
                        : new CrossoverOperator(configuration, CROSSOVER_SHARE, true, true),
                new MutationOperator(configuration, MUTATION_DENOMINATOR),
                stock ? new GaussianMutationOperator(configuration, deviation)
                        : new GaussianMutation(configuration, deviation, random));
    }

    /** Takes the best, each at most once. */
    static NaturalSelector elite(Configuration configuration) throws InvalidConfigurationException {
        BestChromosomesSelector selector = new BestChromosomesSelector(configuration, 1.0);
        selector.setDoubletteChromosomesAllowed(false);
        return selector;
    }

    /**
     * Fills up by roulette. To be made anew for each selection: the order on JGAP's wheel depends on all that was ever
     * on it, which no checkpoint could restore.
     */
    static NaturalSelector roulette(EvolutionSettings settings, Configuration configuration)
            throws InvalidConfigurationException {
        return settings.search().operators() == OperatorSet.STOCK ? new WeightedRouletteSelector(configuration)
                : new RouletteSelector(configuration);
    }
}
