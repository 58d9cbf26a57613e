package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.encoding.GeneRange;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;

/** Uniformly random genomes, as many in each generation as the population's size. */
record RandomSearch(EvolutionSettings settings, List<GeneRange> ranges) implements Optimizer {

    @Override
    public List<List<Double>> propose(int generation, List<Individual> before) {
        return genomes(settings.search().population(), ranges,
                new SplittableRandom(Seeds.of(settings.search().seed(), generation)));
    }

    /** So many. */
    static List<List<Double>> genomes(int count, List<GeneRange> ranges, SplittableRandom random) {
        List<List<Double>> genomes = new ArrayList<>();
        for (int i = 0; i < count; i++) {
            genomes.add(ranges.stream().map(range -> random.nextDouble(range.lower(), range.upper())).toList());
        }
        return genomes;
    }
}
