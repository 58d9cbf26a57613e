package io.natator.evolution;

import io.natator.encoding.GeneRange;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.uma.jmetal.solution.doublesolution.DoubleSolution;
import org.uma.jmetal.solution.doublesolution.impl.DefaultDoubleSolution;
import org.uma.jmetal.util.bounds.Bounds;
import org.uma.jmetal.util.densityestimator.impl.CrowdingDistanceDensityEstimator;
import org.uma.jmetal.util.ranking.Ranking;
import org.uma.jmetal.util.ranking.impl.FastNonDominatedSortRanking;

/** Individuals of several objectives as jMetal ranks them, which takes less for better. */
public final class ParetoRanking {

    private static final String INDIVIDUAL = "individual";

    private final List<Bounds<Double>> bounds;

    ParetoRanking(List<GeneRange> ranges) {
        this.bounds = ranges.stream().map(range -> Bounds.create(range.lower(), range.upper())).toList();
    }

    /**
     * Those of a population that no other is better than in every objective, the best by the first objective first.
     *
     * @param ranges of the genes
     */
    public static List<Individual> front(List<Individual> population, List<GeneRange> ranges) {
        ParetoRanking ranking = new ParetoRanking(ranges);
        List<DoubleSolution> solutions = ranking.solutions(population);
        if (solutions.isEmpty()) {
            return List.of();
        }
        Ranking<DoubleSolution> ranked = new FastNonDominatedSortRanking<DoubleSolution>().compute(solutions);
        return ranked.getSubFront(0).stream().map(ranking::individual)
                .sorted(Comparator.comparingDouble((Individual one) -> one.objectives().get(0)).reversed()).toList();
    }

    /** Individuals that were measured, each gait once. */
    List<DoubleSolution> solutions(List<Individual> individuals) {
        List<DoubleSolution> solutions = new ArrayList<>();
        Set<List<Double>> known = new HashSet<>();
        for (Individual one : individuals) {
            if (one.isMeasured() && known.add(one.genes())) {
                DoubleSolution solution = new DefaultDoubleSolution(bounds, one.objectives().size(), 0);
                for (int i = 0; i < one.genes().size(); i++) {
                    solution.variables().set(i, one.genes().get(i));
                }
                for (int i = 0; i < one.objectives().size(); i++) {
                    solution.objectives()[i] = -one.objectives().get(i);
                }
                solution.attributes().put(INDIVIDUAL, one);
                solutions.add(solution);
            }
        }
        return solutions;
    }

    Individual individual(DoubleSolution solution) {
        return (Individual) solution.attributes().get(INDIVIDUAL);
    }

    /** Lower fronts first, in a front what has more room around it. */
    Comparator<DoubleSolution> comparator(List<DoubleSolution> solutions) {
        Ranking<DoubleSolution> ranked = new FastNonDominatedSortRanking<DoubleSolution>().compute(solutions);
        CrowdingDistanceDensityEstimator<DoubleSolution> crowding = new CrowdingDistanceDensityEstimator<>();
        Map<DoubleSolution, Integer> ranks = new HashMap<>();
        for (int front = 0; front < ranked.getNumberOfSubFronts(); front++) {
            List<DoubleSolution> members = ranked.getSubFront(front);
            crowding.compute(members);
            for (DoubleSolution one : members) {
                ranks.put(one, front);
            }
        }
        return Comparator.comparing((DoubleSolution one) -> ranks.get(one))
                .thenComparing(Comparator.comparing(crowding::value).reversed());
    }
}
