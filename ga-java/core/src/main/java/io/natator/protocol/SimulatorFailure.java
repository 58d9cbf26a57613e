package io.natator.protocol;

/** One call of the native program went wrong; the message says how. */
public final class SimulatorFailure extends Exception {

    private static final long serialVersionUID = 1L;

    /** A failure with its description. */
    public SimulatorFailure(String message) {
        super(message);
    }

    /** A failure with its description and cause. */
    public SimulatorFailure(String message, Throwable cause) {
        super(message, cause);
    }
}
