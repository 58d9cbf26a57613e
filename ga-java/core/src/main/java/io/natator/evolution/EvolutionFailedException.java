package io.natator.evolution;

/** An evolution cannot go on; the message says why. */
public class EvolutionFailedException extends RuntimeException {

    private static final long serialVersionUID = 1L;

    /** A failure with its reason in one line. */
    public EvolutionFailedException(String message) {
        super(message);
    }

    EvolutionFailedException(String message, Throwable cause) {
        super(message, cause);
    }

    /** Whether so many failures in a generation end the evolution: most of its simulations. */
    public static boolean isDue(int failed, int simulations) {
        return 2 * failed > simulations;
    }
}
