package io.natator.simulator;

/** One call of the native program went wrong; the message says how. */
final class SimulatorFailure extends Exception {

    private static final long serialVersionUID = 1L;

    SimulatorFailure(String message) {
        super(message);
    }

    SimulatorFailure(String message, Throwable cause) {
        super(message, cause);
    }
}
