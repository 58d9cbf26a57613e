package io.natator.run;

import io.natator.evolution.Departure;
import io.natator.evolution.Migrant;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/**
 * Where islands, each a thread, leave gaits for the next one. An island waits only for the one before it, and only until that
 * one has come as far; what it gets depends on that island's course and not on who was faster.
 */
final class Ring {

    /** Of each island what left it, by generations. */
    private final List<Map<Integer, List<Migrant>>> left = new ArrayList<>();
    private final boolean[] ended;
    private boolean stopped;

    /** Islands that nobody has left yet. */
    Ring(int islands) {
        for (int i = 0; i < islands; i++) {
            left.add(new HashMap<>());
        }
        ended = new boolean[islands];
    }

    /** Gaits leave an island, numbered from 1. */
    synchronized void leave(int island, Departure departure) {
        left.get(island - 1).put(departure.generation(), departure.migrants());
        notifyAll();
    }

    /** Nobody leaves an island any more. */
    synchronized void end(int island) {
        ended[island - 1] = true;
        notifyAll();
    }

    /** No island goes on: who waits gets an {@link InterruptedException}. */
    synchronized void stop() {
        stopped = true;
        notifyAll();
    }

    /**
     * What left an island after a generation, once it has come so far; nobody if it ended before.
     *
     * @throws InterruptedException if {@link #stop} is called, or the calling thread is interrupted
     */
    synchronized List<Migrant> from(int island, int generation) throws InterruptedException {
        Map<Integer, List<Migrant>> of = left.get(island - 1);
        while (!of.containsKey(generation) && !ended[island - 1]) {
            if (stopped) {
                throw new InterruptedException("the islands were stopped");
            }
            wait();
        }
        return of.getOrDefault(generation, List.of());
    }
}
