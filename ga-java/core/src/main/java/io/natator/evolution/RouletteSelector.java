package io.natator.evolution;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.jgap.Configuration;
import org.jgap.IChromosome;
import org.jgap.InvalidConfigurationException;
import org.jgap.NaturalSelectorExt;
import org.jgap.Population;
import org.jgap.RandomGenerator;

/**
 * Roulette wheel selection: each draw takes a chromosome with a probability in proportion to its fitness. Draws are
 * with replacement, the textbook wheel, so a fit chromosome may be drawn several times; all but the first are copies.
 * When no chromosome has any fitness, all are equally likely.
 *
 * <p>It stands for JGAP's {@link org.jgap.impl.WeightedRouletteSelector}, which gives every chromosome the share of
 * another one and draws without replacement.
 */
@SuppressWarnings("serial") // JGAP makes selectors serializable; this one is made anew for each selection.
final class RouletteSelector extends NaturalSelectorExt {

    private final transient List<IChromosome> candidates = new ArrayList<>();

    RouletteSelector(Configuration configuration) throws InvalidConfigurationException {
        super(configuration);
    }

    @Override
    protected void add(IChromosome chromosome) {
        candidates.add(chromosome);
    }

    @Override
    protected void selectChromosomes(int count, Population selected) {
        double[] upperEdges = upperEdges();
        RandomGenerator random = getConfiguration().getRandomGenerator();
        for (int i = 0; i < count; i++) {
            selected.addChromosome(take(candidates.get(spin(upperEdges, random))));
        }
    }

    /** Where the slot of each chromosome ends on the wheel. */
    private double[] upperEdges() {
        double[] edges = new double[candidates.size()];
        double total = 0.0;
        for (int i = 0; i < edges.length; i++) {
            total += candidates.get(i).getFitnessValueDirectly();
            edges[i] = total;
        }
        if (total == 0.0) {
            Arrays.setAll(edges, i -> i + 1.0);
        }
        return edges;
    }

    private static int spin(double[] upperEdges, RandomGenerator random) {
        double point = random.nextDouble() * upperEdges[upperEdges.length - 1];
        int slot = 0;
        while (upperEdges[slot] <= point) {
            slot++;
        }
        return slot;
    }

    /** The chromosome itself if nobody selected it yet, else a copy: the selected must not share their ages. */
    private static IChromosome take(IChromosome chromosome) {
        if (!chromosome.isSelectedForNextGeneration()) {
            chromosome.setIsSelectedForNextGeneration(true);
            return chromosome;
        }
        IChromosome copy = (IChromosome) chromosome.clone();
        copy.setFitnessValueDirectly(chromosome.getFitnessValueDirectly());
        copy.setAge(chromosome.getAge());
        return copy;
    }

    @Override
    public void empty() {
        candidates.clear();
    }

    @Override
    public boolean returnsUniqueChromosomes() {
        return false;
    }
}
