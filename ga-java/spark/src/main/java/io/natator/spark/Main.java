package io.natator.spark;

import java.util.List;
import picocli.CommandLine;

/** The program {@code natator} for {@code spark-submit}: all commands but those that need a web server or its files. */
public final class Main {

    private static final List<String> ELSEWHERE = List.of("view", "page");

    private Main() {
    }

    /**
     * Runs a command, and leaves the cluster afterwards.
     *
     * @param arguments the command line
     */
    public static void main(String[] arguments) {
        CommandLine command = io.natator.cli.Main.commandLine();
        ELSEWHERE.forEach(command.getCommandSpec()::removeSubcommand);
        try {
            io.natator.cli.Main.run(command, arguments);
        } finally {
            Cluster.leave();
        }
    }
}
