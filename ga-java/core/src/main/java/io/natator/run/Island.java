package io.natator.run;

import io.natator.checkpoint.RunFolder;
import io.natator.config.Migration;
import io.natator.evolution.Departure;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.Exchange;
import io.natator.evolution.Individual;
import io.natator.evolution.Migrant;
import io.natator.evolution.Settlers;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/**
 * A run's place in a ring. What leaves it is in its folder before the next island gets it. So whoever went on by it finds it
 * again after a kill, though the population that it came from may be gone by then.
 */
final class Island implements Exchange {

    private final RunFolder folder;
    private final Migration migration;
    private final Ring ring;
    private final Map<Integer, Departure> departures = new HashMap<>();
    /** Where the gaits were born that have come here, by their genes. */
    private final Map<List<Double>, Integer> strangers = new HashMap<>();

    /**
     * As far as the folder has come.
     *
     * @param before what has left the island before this one
     */
    Island(RunFolder folder, Ring ring, List<Departure> before) {
        this.folder = folder;
        this.migration = folder.settings().migration();
        this.ring = ring;
        folder.departures().forEach(one -> departures.put(one.generation(), one));
        int generation = folder.checkpoint() == null ? 0 : folder.checkpoint().generation();
        before.stream().filter(one -> one.generation() < generation).forEach(one -> welcome(one.migrants()));
    }

    private void welcome(List<Migrant> coming) {
        coming.stream().filter(one -> one.born() != migration.island())
                .forEach(one -> strangers.put(one.individual().genes(), one.born()));
    }

    @Override
    public List<Individual> parents(EvolutionState state) throws InterruptedException {
        if (!migration.isAfter(state.generation())) {
            return state.population();
        }
        ring.leave(migration.island(), departure(state));
        List<Migrant> coming = ring.from(migration.before(), state.generation());
        welcome(coming);
        return Settlers.settle(state.population(), coming.stream().map(Migrant::individual).toList());
    }

    /** As it is recorded, else recorded now. */
    private Departure departure(EvolutionState state) {
        Departure known = departures.get(state.generation());
        if (known != null) {
            return known;
        }
        Departure departure = new Departure(state.generation(), Settlers.best(state.population(), migration.migrants()).stream()
                .map(one -> new Migrant(strangers.getOrDefault(one.genes(), migration.island()), one)).toList());
        folder.append(departure);
        return departure;
    }

    @Override
    public boolean isNative(Individual individual) {
        return !strangers.containsKey(individual.genes());
    }
}
