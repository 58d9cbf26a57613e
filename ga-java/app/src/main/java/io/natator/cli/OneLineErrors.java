package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.evolution.EvolutionFailedException;
import io.natator.process.ProgramEnd;
import io.natator.protocol.RequestRejectedException;
import java.io.UncheckedIOException;
import java.nio.file.InvalidPathException;
import java.util.List;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;
import picocli.CommandLine;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.IExecutionStrategy;
import picocli.CommandLine.MissingParameterException;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.ParseResult;
import picocli.CommandLine.UnmatchedArgumentException;

/** Tells of every error in one line on standard error, and chooses the exit status. */
final class OneLineErrors {

    private static final Logger LOG = LoggerFactory.getLogger(OneLineErrors.class);

    private OneLineErrors() {
    }

    static int badUsage(ParameterException error, String[] arguments) {
        CommandLine command = error.getCommandLine();
        String unmatched = unmatched(error);
        String what = unmatched != null ? unknown(unmatched, command)
                : NumberValues.withLeast(error.getArgSpec(), error.getMessage())
                        .replaceFirst("positional parameter at index \\S+ \\((.*?)\\)", "$1")
                        .replaceFirst("\\.$", "");
        print(command, what + (what.endsWith("?") ? " See " : "; see ") + command.getCommandSpec().qualifiedName()
                + " --help");
        return ExitCode.USAGE;
    }

    /** What was not understood; null if nothing, or it stands where an option's value should, which the message alone tells. */
    private static String unmatched(ParameterException error) {
        if (error instanceof UnmatchedArgumentException unmatched) {
            return unmatched.getUnmatched().stream().findFirst().orElse(null);
        }
        // What is missing was probably given under a mistyped name.
        return error instanceof MissingParameterException ? error.getCommandLine().getUnmatchedArguments().stream()
                .filter(argument -> argument.startsWith("-")).findFirst().orElse(null) : null;
    }

    /** What is unknown, with the known names that picocli finds near. */
    private static String unknown(String argument, CommandLine command) {
        String name = argument.replaceFirst("^(-.*?)=.*", "$1");
        List<String> near = new UnmatchedArgumentException(command, List.of(name)).getSuggestions();
        return (argument.startsWith("-") ? name + " is no option of this command"
                : "'" + argument
                        + (command.getSubcommands().isEmpty() ? "' is one argument too many" : "' is no command"))
                + (near.isEmpty() ? "" : "; did you mean " + EnumNames.choice(near) + "?");
    }

    /** Makes a command, and those below it, tell in one line what Java itself lacks: memory for what was asked, or a part of the program. */
    static void installJava(CommandLine command) {
        IExecutionStrategy usual = command.getExecutionStrategy();
        command.setExecutionStrategy(parsed -> {
            try {
                return usual.execute(parsed);
            } catch (OutOfMemoryError e) {
                return lacking(parsed, "not enough memory: Java may take " + (Runtime.getRuntime().maxMemory() >> 20)
                        + " MiB; give it more by JAVA_TOOL_OPTIONS=-Xmx16g, say");
            } catch (LinkageError e) {
                return lacking(parsed, "a part of the program cannot be loaded: " + e.getMessage()
                        + "; expected more open files than ulimit -n allows, or the jar as it was at the start");
            }
        });
    }

    private static int lacking(ParseResult parsed, String what) {
        print(parsed.asCommandLineList().get(parsed.asCommandLineList().size() - 1), what);
        return ExitCode.SOFTWARE;
    }

    static int failure(Exception error, CommandLine command, ParseResult parsed) {
        LOG.debug("failed", error);
        if (error instanceof InterruptedException || ProgramEnd.hasBegun()) {
            print(command, "interrupted");
            return ExitCode.SOFTWARE;
        }
        if (error instanceof InvalidInputException) {
            print(command, error.getMessage());
            return ExitCode.USAGE;
        }
        if (error instanceof InvalidPathException name) {
            print(command, "'" + name.getInput() + "' cannot be the name of a file: " + name.getReason());
            return ExitCode.USAGE;
        }
        if (error instanceof RequestRejectedException rejected) {
            print(command, "simulator: " + error.getMessage());
            return rejected.isBadInput() ? ExitCode.USAGE : ExitCode.SOFTWARE;
        }
        boolean foreseen = error instanceof EvolutionFailedException || error instanceof UncheckedIOException;
        print(command, foreseen ? error.getMessage() : "internal error: " + error);
        return ExitCode.SOFTWARE;
    }

    /** Says what is wrong, if anything is, with what goes on all the same. */
    static void warn(CommandLine command, String message) {
        if (message != null) {
            print(command, "warning: " + message);
        }
    }

    /** Says what went wrong. */
    static void print(CommandLine command, String message) {
        String line = message.strip().replaceAll("\\s*\\R\\s*", " | ");
        command.getErr().println(command.getCommandSpec().qualifiedName() + ": " + line);
    }
}
