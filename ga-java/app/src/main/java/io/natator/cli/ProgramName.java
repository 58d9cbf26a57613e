package io.natator.cli;

/** How this program was called, for the commands that it suggests. */
final class ProgramName {

    private ProgramName() {
    }

    /** As typed, which its launcher passes on; {@code natator} without a launcher. */
    static String asCalled() {
        return System.getProperty("natator.command", "natator");
    }
}
