package io.natator.evolution;

/** Follows an evolution. Called on the evolution's thread, which waits. */
public interface EvolutionListener {

    /**
     * A generation has been bred and is about to be simulated.
     *
     * @param generation  its number, 0 for the random one
     * @param simulations how many simulations it needs
     */
    default void generationStarted(int generation, int simulations) {
    }

    /** A simulation has ended; they come in the order of their ids. */
    default void evaluated(EvaluationRecord evaluation) {
    }

    /** A generation is finished; the evolution could continue from this state. */
    default void generationFinished(EvolutionState state) {
    }
}
