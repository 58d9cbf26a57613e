package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

/**
 * Runs the best gaits so far again from new starts, in each generation. Half of the runs go to the best, so that no gait
 * stays among them by luck; the other half where a choice is close, by standard errors: around the border of the best,
 * and around the first place.
 */
final class Reevaluation {

    private final EvolutionSettings settings;
    private final Repeater repeater;
    private final int places;
    /** All by their genes, in the order in which they came; those that were measured may be among the best. */
    private final Map<List<Double>, Individual> field = new LinkedHashMap<>();

    private final Set<List<Double>> refused = new LinkedHashSet<>();

    /** Runs gaits again. */
    @FunctionalInterface
    interface Repeater {

        /**
         * Runs each from the same new starts, as far as the run's number of evaluations goes.
         *
         * @param first  number of the first start in this generation
         * @param starts how many
         * @return them with what they are worth by all their runs
         */
        List<Individual> repeat(List<Individual> individuals, int first, int starts);
    }

    /**
     * The re-evaluation of a generation.
     *
     * @param population its individuals
     * @param champions  of the generation before
     * @param refused    genes of those that were unstable in some of their runs
     */
    Reevaluation(EvolutionSettings settings, Repeater repeater, List<Individual> population, List<Individual> champions,
            Collection<List<Double>> refused) {
        this.settings = settings;
        this.repeater = repeater;
        this.places = Math.max(settings.search().elites(), 1);
        this.refused.addAll(refused);
        population.forEach(this::enter);
        champions.forEach(this::enter);
    }

    /** An unstable gait stays in the field but is never ranked, whatever its earlier runs. */
    private void enter(Individual entering) {
        Individual one = refused.contains(entering.genes()) ? entering.withEstimate(entering.estimate().refused())
                : entering;
        if (!one.isStable() && one.result().status() == SimulationResult.Status.OK) {
            refused.add(one.genes());
        }
        field.merge(one.genes(), one, (known, other) -> !known.isStable() ? known
                : !other.isStable() || other.runs() >= known.runs() ? other : known);
    }

    /**
     * Carries it out.
     *
     * @return the champions, the best first
     */
    List<Individual> run() {
        int starts = settings.search().starts();
        int forBest = (starts + 1) / 2;
        repeater.repeat(first(ranked()), starts, forBest).forEach(this::enter);
        repeater.repeat(first(closest()), starts + forBest, starts - forBest).forEach(this::enter);
        return first(ranked());
    }

    /**
     * Gives the best what is left where no other gait could have all its starts.
     *
     * @param runs fewer than the starts of a gait
     * @return the champions
     */
    List<Individual> useUp(int runs) {
        List<Individual> ranked = ranked();
        repeater.repeat(ranked.subList(0, Math.min(1, ranked.size())), 2 * settings.search().starts(), runs)
                .forEach(this::enter);
        return first(ranked());
    }

    /** The champion to take for the best; null without champions. */
    Individual winner() {
        List<Individual> champions = first(ranked());
        return champions.isEmpty() ? null
                : champions.get(LowerConfidenceBound.of(champions.stream().map(Individual::estimate).toList()));
    }

    /** Genes of those that were unstable in some of their runs, up to now; null without any. */
    List<List<Double>> refused() {
        return refused.isEmpty() ? null : List.copyOf(refused);
    }

    /** An individual as it is known now. */
    Individual known(Individual one) {
        Individual known = field.get(one.genes());
        return known == null ? one : one.withEstimate(known.estimate());
    }

    private List<Individual> first(List<Individual> individuals) {
        return List.copyOf(individuals.subList(0, Math.min(places, individuals.size())));
    }

    private List<Individual> ranked() {
        List<Individual> ranked = new ArrayList<>(field.values());
        ranked.removeIf(one -> !one.isMeasured());
        ranked.sort(Comparator.comparingDouble(Individual::score).reversed());
        return ranked;
    }

    /** Those first whose place is least certain. */
    private List<Individual> closest() {
        List<Individual> ranked = ranked();
        if (ranked.size() < 2) {
            return ranked;
        }
        double border = ranked.size() <= places ? Double.NEGATIVE_INFINITY
                : (ranked.get(places - 1).score() + ranked.get(places).score()) / 2;
        double lead = ranked.get(0).score();
        Map<List<Double>, Double> closeness = new LinkedHashMap<>();
        for (int i = 0; i < ranked.size(); i++) {
            Individual one = ranked.get(i);
            double toLead = i == 0 ? lead - ranked.get(1).score() : lead - one.score();
            // All gaits are taken to scatter alike: a few runs do not tell by how much each does.
            closeness.put(one.genes(), Math.min(Math.abs(one.score() - border), toLead) * Math.sqrt(one.runs()));
        }
        ranked.sort(Comparator.comparingDouble(one -> closeness.get(one.genes())));
        return ranked;
    }
}
