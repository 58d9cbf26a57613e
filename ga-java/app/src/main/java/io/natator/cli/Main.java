package io.natator.cli;

import java.io.PrintWriter;
import java.nio.charset.Charset;
import java.nio.charset.StandardCharsets;
import java.util.Locale;
import java.util.concurrent.Callable;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Spec;

/** The {@code natator} program. Results go to standard output, logs and progress to standard error. */
@Command(name = "natator", description = "Evolves and evaluates gaits of swimming soft bodies.",
        subcommands = {EvolveCommand.class, ResumeCommand.class, EvaluateCommand.class, ShowCommand.class,
                CheckCommand.class, ConvergeCommand.class,
                CompareCommand.class, ViewCommand.class, PageCommand.class, NewCommand.class},
        mixinStandardHelpOptions = true, versionProvider = Main.Version.class,
        footer = {"", "Exit status: 0 done, 1 failure, 2 bad usage or input, 130 Ctrl-C, 143 SIGTERM."})
public final class Main implements Callable<Integer> {

    @Spec
    private CommandSpec spec;

    private Main() {
    }

    /** How this program was called, for the commands that it suggests: as typed, which its launcher passes on. */
    static String asCalled() {
        return System.getProperty("natator.command", "natator");
    }

    /** Without a command: what there is. */
    @Override
    public Integer call() {
        spec.commandLine().usage(spec.commandLine().getErr());
        return CommandLine.ExitCode.USAGE;
    }

    /**
     * Runs a command. Ends the virtual machine only if it fails, so that a program that calls this can go on.
     *
     * @param arguments the command line
     */
    public static void main(String[] arguments) {
        run(commandLine(), arguments);
    }

    /**
     * Runs a command with a command line that may have been changed.
     *
     * @param command see {@link #commandLine}
     */
    public static void run(CommandLine command, String[] arguments) {
        System.setProperty("java.awt.headless", "true");
        Locale.setDefault(Locale.ROOT);  // others write numbers in digits and with signs of their own
        if (Charset.defaultCharset().equals(StandardCharsets.US_ASCII)) {
            // A container without a locale: terminals show UTF-8 there too, and the signs in texts (±) are no question marks.
            command.setOut(new PrintWriter(System.out, true, StandardCharsets.UTF_8));
            command.setErr(new PrintWriter(System.err, true, StandardCharsets.UTF_8));
        }
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

    /** All commands. */
    public static CommandLine commandLine() {
        CommandLine command = new CommandLine(new Main()).setUnmatchedOptionsAllowedAsOptionParameters(false)
                .setParameterExceptionHandler(OneLineErrors::badUsage)
                .setExecutionExceptionHandler(OneLineErrors::failure);
        EnumNames.install(command);
        NumberValues.install(command);
        SectionedHelp.install(command);
        EmptyValues.refuse(command);
        OneLineErrors.installJava(command);
        return command;
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
