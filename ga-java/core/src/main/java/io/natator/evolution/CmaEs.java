package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.encoding.GeneRange;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.hipparchus.analysis.MultivariateFunction;
import org.hipparchus.optim.InitialGuess;
import org.hipparchus.optim.MaxEval;
import org.hipparchus.optim.SimpleBounds;
import org.hipparchus.optim.nonlinear.scalar.GoalType;
import org.hipparchus.optim.nonlinear.scalar.ObjectiveFunction;
import org.hipparchus.optim.nonlinear.scalar.noderiv.CMAESOptimizer;
import org.hipparchus.random.RandomGenerator;
import org.hipparchus.random.Well19937c;

/**
 * Covariance matrix adaptation evolution strategy (Hansen and Ostermeier 2001, active as in Jastrebski and Arnold 2006),
 * by Hipparchus: the thesis names it as the alternative to its genetic algorithm. Genes are scaled to [0, 1]; a search
 * begins at a random point with a step of 0.3, and one that has converged is followed by another from a new point.
 *
 * <p>Hipparchus asks for one value after another and keeps its state to itself. But a generation's points do not depend
 * on each other's values. So for each generation the search is carried out anew from its beginning with the values that
 * are known, up to where it has asked for all points of the generation; these are evaluated together. With that, the
 * values recorded of an interrupted run are all that is needed to continue it.
 */
final class CmaEs implements Optimizer {

    /** A third of the range: Hansen's advice for bounded genes (The CMA Evolution Strategy: A Tutorial, 2016). */
    private static final double STEP = 0.3;

    private final EvolutionSettings settings;
    private final List<GeneRange> ranges;
    /** All finished generations of the present search. */
    private final List<Individual> known = new ArrayList<>();
    /** Searches that have converged. */
    private int searches;

    CmaEs(EvolutionSettings settings, List<GeneRange> ranges) {
        this.settings = settings;
        this.ranges = ranges;
    }

    @Override
    public void recall(List<List<Individual>> earlier) {
        int size = settings.search().population();
        List<Individual> all = earlier.stream().flatMap(List::stream).toList();
        for (int first = 0; first + size <= all.size(); first += size) {
            points();
            known.addAll(all.subList(first, first + size));
        }
    }

    @Override
    public List<List<Double>> propose(int generation, List<Individual> before) {
        return points().stream().map(this::genes).toList();
    }

    @Override
    public List<Individual> population(List<Individual> newborns) {
        known.addAll(newborns);
        return newborns;
    }

    /** The points of the next generation in [0, 1]^n; of a new search if the present one has converged. */
    private List<double[]> points() {
        Replay replay = new Replay(values(), settings.search().population());
        try {
            search(replay);
        } catch (GenerationComplete e) {
            return replay.asked;
        }
        known.clear();
        searches++;
        return points();
    }

    private void search(Replay replay) {
        int dimension = ranges.size();
        RandomGenerator random = new Well19937c(Seeds.of(settings.search().seed(), searches));
        double[] start = new double[dimension];
        Arrays.setAll(start, i -> random.nextDouble());
        double[] step = new double[dimension];
        Arrays.fill(step, STEP);
        double[] upper = new double[dimension];
        Arrays.fill(upper, 1.0);
        new CMAESOptimizer(Integer.MAX_VALUE, 0, true, 0, 0, random, false, null).optimize(
                new ObjectiveFunction(replay), GoalType.MAXIMIZE, MaxEval.unlimited(), new InitialGuess(start),
                new SimpleBounds(new double[dimension], upper), new CMAESOptimizer.Sigma(step),
                new CMAESOptimizer.PopulationSize(settings.search().population()));
    }

    private List<Double> genes(double[] point) {
        List<Double> genes = new ArrayList<>();
        for (int i = 0; i < point.length; i++) {
            GeneRange range = ranges.get(i);
            genes.add(Math.min(range.lower() + point[i] * range.width(), range.upper()));
        }
        return genes;
    }

    /** Signed distances; what was unstable or failed is worth as much as the worst of its generation. */
    private double[] values() {
        double[] values = new double[known.size()];
        for (int first = 0; first < values.length; first += settings.search().population()) {
            List<Individual> generation = known.subList(first,
                    Math.min(first + settings.search().population(), known.size()));
            double worst = generation.stream().filter(Individual::isMeasured).mapToDouble(Individual::score).min()
                    .orElse(0.0);
            for (int i = 0; i < generation.size(); i++) {
                values[first + i] = generation.get(i).isMeasured() ? generation.get(i).score() : worst;
            }
        }
        return values;
    }

    /** Gives the known values, then takes down the points that it is asked for. */
    private static final class Replay implements MultivariateFunction {

        private final double[] values;
        private final int population;
        private final List<double[]> asked = new ArrayList<>();
        private int next;

        Replay(double[] values, int population) {
            this.values = values;
            this.population = population;
        }

        @Override
        public double value(double[] point) {
            if (next < values.length) {
                return values[next++];
            }
            asked.add(point.clone());
            if (asked.size() == population) {
                throw new GenerationComplete();
            }
            return 0.0;
        }
    }

    /** Ends a search whose next values are not known yet. */
    private static final class GenerationComplete extends RuntimeException {

        private static final long serialVersionUID = 1L;

        GenerationComplete() {
            super("generation complete", null, false, false);
        }
    }
}
