package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Path;
import picocli.CommandLine;

/** Commands that tests of other parts need the outcome of. */
public final class Commands {

    private Commands() {
    }

    /** What a command prints, which must succeed. */
    public static String natator(String... arguments) {
        StringWriter printed = new StringWriter();
        StringWriter errors = new StringWriter();
        CommandLine command = Main.commandLine().setOut(new PrintWriter(printed, true))
                .setErr(new PrintWriter(errors, true));
        assertThat(command.execute(arguments)).as(errors.toString()).isZero();
        return printed.toString();
    }

    /** Evolves creature 1 in the thesis' tank for three generations of eight, with another scheme than the scene's. */
    public static void evolve(Path simulator, Path folder) {
        evolve(simulator, folder, "thesis/creature-1");
    }

    /** The same in another scene. */
    public static void evolve(Path simulator, Path folder, String scene) {
        natator("evolve", "--simulator-path", simulator.toString(), "--no-cache", "--population", "8", "--generations",
                "3", "--seed", "5", "--optimizer", "random", "--scene", scene, "--scheme", "conserving",
                "--output-dir", folder.toString());
    }
}
