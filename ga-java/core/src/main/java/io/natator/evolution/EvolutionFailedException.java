package io.natator.evolution;

/** An evolution cannot go on; the message says why. */
public class EvolutionFailedException extends RuntimeException {

    private static final long serialVersionUID = 1L;

    /** For this reason, in one line. */
    public EvolutionFailedException(String message) {
        super(message);
    }

    EvolutionFailedException(String message, Throwable cause) {
        super(message, cause);
    }
}
