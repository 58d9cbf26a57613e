package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.encoding.GeneRange;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.SplittableRandom;
import org.uma.jmetal.operator.crossover.impl.SBXCrossover;
import org.uma.jmetal.operator.mutation.impl.PolynomialMutation;
import org.uma.jmetal.operator.selection.impl.RankingAndCrowdingSelection;
import org.uma.jmetal.solution.doublesolution.DoubleSolution;
import org.uma.jmetal.solution.doublesolution.repairsolution.impl.RepairDoubleSolutionWithBoundValue;
import org.uma.jmetal.util.pseudorandom.RandomGenerator;

/**
 * NSGA-II (Deb, Pratap, Agarwal, Meyarivan 2002) with jMetal's operators and its ranking. A population holds the parents
 * that survived and their children. Between generations it keeps nothing, as the genetic algorithm.
 */
final class Nsga2 implements Optimizer {

    /** As in the paper: nine of ten pairs are crossed, one gene of each child is mutated; both with index 20. */
    private static final double CROSSOVER_SHARE = 0.9;
    private static final double INDEX = 20;

    private final EvolutionSettings settings;
    private final List<GeneRange> ranges;
    private final ParetoRanking ranking;
    private List<DoubleSolution> parents = List.of();

    Nsga2(EvolutionSettings settings, List<GeneRange> ranges) {
        this.settings = settings;
        this.ranges = ranges;
        this.ranking = new ParetoRanking(ranges);
    }

    @Override
    public List<List<Double>> propose(int generation, List<Individual> before) {
        SplittableRandom random = new SplittableRandom(Seeds.of(settings.search().seed(), generation));
        List<DoubleSolution> candidates = ranking.solutions(before);
        parents = candidates.size() <= settings.search().population() ? candidates
                : new RankingAndCrowdingSelection<DoubleSolution>(settings.search().population()).execute(candidates);
        return parents.isEmpty() ? RandomSearch.genomes(settings.search().population(), ranges, random)
                : children(random);
    }

    @Override
    public List<Individual> population(List<Individual> newborns) {
        List<Individual> population = new ArrayList<>();
        parents.forEach(
                parent -> population.add(ranking.individual(parent).withAge(ranking.individual(parent).age() + 1)));
        population.addAll(newborns);
        return population;
    }

    private List<List<Double>> children(SplittableRandom random) {
        RandomGenerator<Double> numbers = random::nextDouble;
        SBXCrossover crossover = new SBXCrossover(CROSSOVER_SHARE, INDEX, new RepairDoubleSolutionWithBoundValue(),
                numbers);
        PolynomialMutation mutation = new PolynomialMutation(1.0 / ranges.size(), INDEX,
                new RepairDoubleSolutionWithBoundValue(), numbers);
        Comparator<DoubleSolution> better = ranking.comparator(parents);
        Set<List<Double>> known = new HashSet<>();
        parents.forEach(parent -> known.add(ranking.individual(parent).genes()));
        List<List<Double>> genomes = new ArrayList<>();
        while (genomes.size() < settings.search().population()) {
            List<DoubleSolution> pair = List.of(tournament(better, random), tournament(better, random));
            for (DoubleSolution child : crossover.execute(pair)) {
                List<Double> genes = List.copyOf(mutation.execute(child).variables());
                if (genomes.size() < settings.search().population() && known.add(genes)) {
                    genomes.add(genes);
                }
            }
        }
        return genomes;
    }

    /** The better of two; the first of equals. */
    private DoubleSolution tournament(Comparator<DoubleSolution> better, SplittableRandom random) {
        DoubleSolution one = parents.get(random.nextInt(parents.size()));
        DoubleSolution other = parents.get(random.nextInt(parents.size()));
        return better.compare(one, other) <= 0 ? one : other;
    }
}
