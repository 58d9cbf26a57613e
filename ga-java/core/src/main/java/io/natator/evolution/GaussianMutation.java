package io.natator.evolution;

import java.util.List;
import java.util.Random;
import org.jgap.BaseGeneticOperator;
import org.jgap.Configuration;
import org.jgap.Gene;
import org.jgap.IChromosome;
import org.jgap.InvalidConfigurationException;
import org.jgap.Population;
import org.jgap.impl.DoubleGene;

/**
 * Gaussian mutation of every gene of the population (thesis 2.6): for each selected chromosome a new one, each of whose
 * genes is shifted by normal noise with mean 0 and a deviation in proportion to the gene's range. What would leave the
 * range is reflected at its bound. The selected chromosomes stay as they are.
 *
 * <p>It stands for JGAP's {@link org.jgap.impl.GaussianMutationOperator}, whose noise is uniform and only ever upward.
 */
final class GaussianMutation extends BaseGeneticOperator {

    private static final long serialVersionUID = 1L;

    private final double deviation;
    private final Random random;

    /**
     * A mutation.
     *
     * @param deviation as a share of each gene's range, above 0
     * @param random    source of the noise
     */
    GaussianMutation(Configuration configuration, double deviation, Random random)
            throws InvalidConfigurationException {
        super(configuration);
        this.deviation = deviation;
        this.random = random;
    }

    @Override
    @SuppressWarnings({"rawtypes", "unchecked"}) // JGAP's lists of candidates have no element type.
    public void operate(Population population, List candidates) {
        int parents = Math.min(getConfiguration().getPopulationSize(), population.size());
        for (int i = 0; i < parents; i++) {
            IChromosome child = (IChromosome) population.getChromosome(i).clone();
            for (Gene gene : child.getGenes()) {
                mutate((DoubleGene) gene);
            }
            candidates.add(child);
        }
    }

    private void mutate(DoubleGene gene) {
        double lower = gene.getLowerBound();
        double upper = gene.getUpperBound();
        double shifted = gene.doubleValue() + deviation * (upper - lower) * random.nextGaussian();
        gene.setAllele(reflect(shifted, lower, upper));
    }

    /** Reflects a value at the bounds of its range. */
    static double reflect(double value, double lower, double upper) {
        double width = upper - lower;
        double offset = Math.abs(value - lower) % (2.0 * width);
        double folded = lower + (offset <= width ? offset : 2.0 * width - offset);
        return Math.min(Math.max(folded, lower), upper);
    }

    @Override
    public int compareTo(Object other) {
        return Double.compare(deviation, ((GaussianMutation) other).deviation);
    }
}
