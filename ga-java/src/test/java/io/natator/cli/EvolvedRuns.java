package io.natator.cli;

import java.io.PrintWriter;
import java.io.Writer;
import java.nio.file.Path;
import picocli.CommandLine;

/** Run folders for tests of what reads them. */
public final class EvolvedRuns {

    private EvolvedRuns() {
    }

    /** Evolves creature 1 for three generations of eight, with another scheme than the scene's; the exit status. */
    public static int evolve(Path simulator, Path folder) {
        PrintWriter nowhere = new PrintWriter(Writer.nullWriter());
        CommandLine command = Main.commandLine().setOut(nowhere).setErr(nowhere);
        return command.execute("evolve", "--simulator-path", simulator.toString(), "--no-cache", "--population", "8",
                "--generations", "3", "--seed", "5", "--optimizer", "random", "--scheme", "conserving", "--output-dir",
                folder.toString());
    }
}
