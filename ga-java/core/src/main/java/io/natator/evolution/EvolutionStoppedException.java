package io.natator.evolution;

/** An evolution was stopped from outside before its end. What it had done is recorded, and it can be continued. */
public class EvolutionStoppedException extends RuntimeException {

    private static final long serialVersionUID = 1L;

    /** A stop for the given reason. */
    public EvolutionStoppedException(String message) {
        super(message);
    }
}
