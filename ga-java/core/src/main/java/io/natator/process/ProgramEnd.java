package io.natator.process;

/** Whether this program was told to end, as by Ctrl-C. */
public final class ProgramEnd {

    private ProgramEnd() {
    }

    /** Whether it was: what fails then may fail because its parts are being stopped. */
    public static boolean hasBegun() {
        Thread probe = new Thread(() -> {
        });
        try {
            Runtime.getRuntime().addShutdownHook(probe);
            Runtime.getRuntime().removeShutdownHook(probe);
            return false;
        } catch (IllegalStateException e) {
            return true;
        }
    }
}
