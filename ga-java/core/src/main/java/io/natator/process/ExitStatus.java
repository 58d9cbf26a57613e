package io.natator.process;

/** Exit statuses of {@code natator-sim}. */
public final class ExitStatus {
    /** It has done what was asked. */
    public static final int OK = 0;
    /** It refuses its input; standard error says why. */
    public static final int BAD_INPUT = 2;
    /** A simulation became unstable. */
    public static final int UNSTABLE = 3;
    /** The device that was asked for is not there. */
    public static final int NO_DEVICE = 4;

    private ExitStatus() {
    }
}
