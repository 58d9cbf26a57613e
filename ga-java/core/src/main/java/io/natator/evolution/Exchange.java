package io.natator.evolution;

import java.util.List;

/**
 * Gaits that come to an evolution from elsewhere. They breed here, but count where they were born: only there can they be the
 * run's best or be run again, so that each gait is judged once, by evaluations that its own run has recorded.
 */
public interface Exchange {

    /** Nothing comes, nothing goes. */
    Exchange NONE = new Exchange() {
        @Override
        public List<Individual> parents(EvolutionState state) {
            return state.population();
        }

        @Override
        public boolean isNative(Individual individual) {
            return true;
        }
    };

    /**
     * What the next generation is bred from. The same for the same state, whenever it is asked for.
     *
     * @param state after the last generation
     * @throws InterruptedException if the exchange ends before what is to come has come
     */
    List<Individual> parents(EvolutionState state) throws InterruptedException;

    /** Whether it was born here. */
    boolean isNative(Individual individual);
}
