package io.natator.cli;

import picocli.CommandLine;
import picocli.CommandLine.Command;

/** The {@code natator} program. Results go to standard output, logs and progress to standard error. */
@Command(name = "natator", description = "Evolves and evaluates gaits of swimming soft bodies.",
        subcommands = {EvolveCommand.class, ResumeCommand.class, EvaluateCommand.class, ShowCommand.class,
            CompareCommand.class, CompareOptimizersCommand.class, CompareFlexCommand.class,
            ReportCommand.class, ViewCommand.class, PageCommand.class, ExportCommand.class, ReproduceCommand.class,
            PlotCommand.class},
        mixinStandardHelpOptions = true,
        versionProvider = Main.Version.class,
        footer = {"", "Exit status: 0 done, 1 failure, 2 bad usage or input."})
public final class Main {

    private Main() {
    }

    /**
     * Runs a command. Ends the virtual machine only if it fails, so that a program that calls this can go on.
     *
     * @param arguments the command line
     */
    public static void main(String[] arguments) {
        System.setProperty("java.awt.headless", "true");
        CommandLine command = commandLine();
        int status = command.execute(arguments);
        command.getOut().flush();
        if (System.out.checkError() && status == CommandLine.ExitCode.OK) {
            System.err.println("natator: standard output cannot be written");
            status = CommandLine.ExitCode.SOFTWARE;
        }
        if (status != CommandLine.ExitCode.OK) {
            System.exit(status);
        }
    }

    static CommandLine commandLine() {
        return new CommandLine(new Main())
                .setCaseInsensitiveEnumValuesAllowed(true)
                .setParameterExceptionHandler(OneLineErrors::badUsage)
                .setExecutionExceptionHandler(OneLineErrors::failure);
    }

    /** The version in the jar's manifest. */
    static final class Version implements CommandLine.IVersionProvider {
        @Override
        public String[] getVersion() {
            String version = Main.class.getPackage().getImplementationVersion();
            return new String[] {"natator " + (version == null ? "(development build)" : version)};
        }
    }
}
