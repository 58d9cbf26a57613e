package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.encoding.GeneRange;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;

/** Uniformly random genomes, as many in each generation as the population's size. */
final class RandomSearch implements Optimizer {

    private final EvolutionSettings settings;
    private final List<GeneRange> ranges;
    private final GenerationEvaluator evaluator;

    RandomSearch(EvolutionSettings settings, List<GeneRange> ranges, GenerationEvaluator evaluator) {
        this.settings = settings;
        this.ranges = ranges;
        this.evaluator = evaluator;
    }

    @Override
    public List<Individual> next(int generation, List<Individual> before) {
        SplittableRandom random = new SplittableRandom(Seeds.of(settings.search().seed(), generation));
        return evaluator.evaluate(genomes(settings.search().population(), ranges, random));
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
