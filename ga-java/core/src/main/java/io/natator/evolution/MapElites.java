package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.encoding.GeneRange;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;

/**
 * MAP-Elites (Mouret and Clune 2015, Illuminating search spaces by mapping elites). The population is the map; children
 * come from two elites by the directional variation of Vassiliades and Mouret (2018, GECCO, Discovering the elite
 * hypervolume): a step of each gene, and one along the line between both. Between generations it keeps nothing, as the
 * genetic algorithm.
 */
final class MapElites implements Optimizer {

    /** Deviations of both steps; that of genes as a share of their ranges. Of the original: 0.01 and 0.2. */
    private static final double GENE_STEP = 0.05;
    private static final double LINE_STEP = 0.2;

    private final EvolutionSettings settings;
    private final List<GeneRange> ranges;
    private List<Individual> elites = List.of();

    MapElites(EvolutionSettings settings, List<GeneRange> ranges) {
        this.settings = settings;
        this.ranges = ranges;
    }

    @Override
    public List<List<Double>> propose(int generation, List<Individual> before) {
        SplittableRandom random = new SplittableRandom(Seeds.of(settings.search().seed(), generation));
        elites = new EliteMap(before).individuals();
        return elites.isEmpty() ? RandomSearch.genomes(settings.search().population(), ranges, random)
                : children(random);
    }

    @Override
    public List<Individual> population(List<Individual> newborns) {
        List<Individual> all = new ArrayList<>();
        elites.forEach(elite -> all.add(elite.withAge(elite.age() + 1)));
        all.addAll(newborns);
        List<Individual> next = new EliteMap(all).individuals();
        return next.isEmpty() ? newborns : next;
    }

    private List<List<Double>> children(SplittableRandom random) {
        List<List<Double>> genomes = new ArrayList<>();
        for (int i = 0; i < settings.search().population(); i++) {
            genomes.add(child(elites.get(random.nextInt(elites.size())).genes(),
                    elites.get(random.nextInt(elites.size())).genes(), random));
        }
        return genomes;
    }

    private List<Double> child(List<Double> one, List<Double> other, SplittableRandom random) {
        double along = LINE_STEP * random.nextGaussian();
        List<Double> genes = new ArrayList<>();
        for (int i = 0; i < ranges.size(); i++) {
            GeneRange range = ranges.get(i);
            double gene = one.get(i) + GENE_STEP * range.width() * random.nextGaussian()
                    + along * (other.get(i) - one.get(i));
            genes.add(Math.min(Math.max(gene, range.lower()), range.upper()));
        }
        return List.copyOf(genes);
    }
}
