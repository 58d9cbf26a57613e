package io.natator.protocol;

/** One call of the native program went wrong; the message says how. */
public final class SimulatorFailure extends Exception {

    private static final long serialVersionUID = 1L;

    /** With what went wrong. */
    public SimulatorFailure(String message) {
        super(message);
    }

    /** With what went wrong, and why. */
    public SimulatorFailure(String message, Throwable cause) {
        super(message, cause);
    }
}
