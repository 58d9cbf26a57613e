package io.natator.evolution;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.stream.IntStream;

/** Who leaves a population, and who of it makes room for those who come. */
public final class Settlers {

    private Settlers() {
    }

    /**
     * The best of a population that differ in their genes, the best first, the earlier of equals; only such as swam.
     *
     * @param count how many at most
     */
    public static List<Individual> best(List<Individual> population, int count) {
        Set<List<Double>> genes = new HashSet<>();
        return population.stream().sorted(Comparator.comparingDouble(Individual::score).reversed())
                .filter(one -> one.isMeasured() && genes.add(one.genes())).limit(count).toList();
    }

    /**
     * A population in which those who come have taken the places of as many of the worst, the later of equals. Who is there
     * already does not come again.
     */
    public static List<Individual> settle(List<Individual> population, List<Individual> coming) {
        Set<List<Double>> genes = new HashSet<>();
        population.forEach(one -> genes.add(one.genes()));
        List<Individual> newcomers = coming.stream().filter(one -> genes.add(one.genes())).toList();
        Set<Integer> worst = new HashSet<>(IntStream.range(0, population.size()).boxed()
                .sorted(Comparator.<Integer>comparingDouble(i -> worth(population.get(i))).thenComparing(Comparator.reverseOrder()))
                .limit(newcomers.size()).toList());
        List<Individual> settled = new ArrayList<>();
        IntStream.range(0, population.size()).filter(i -> !worst.contains(i)).forEach(i -> settled.add(population.get(i)));
        settled.addAll(newcomers);
        return settled;
    }

    private static double worth(Individual one) {
        return one.isMeasured() ? one.score() : Double.NEGATIVE_INFINITY;
    }
}
