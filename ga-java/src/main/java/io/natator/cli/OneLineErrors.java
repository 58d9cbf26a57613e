package io.natator.cli;

import io.natator.config.InvalidInputException;
import io.natator.evolution.EvolutionFailedException;
import io.natator.simulator.RequestRejectedException;
import java.io.UncheckedIOException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;
import picocli.CommandLine;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.ParseResult;

/** Tells of every error in one line on standard error, and chooses the exit status. */
final class OneLineErrors {

    private static final Logger LOG = LoggerFactory.getLogger(OneLineErrors.class);

    private OneLineErrors() {
    }

    static int badUsage(ParameterException error, String[] arguments) {
        print(error.getCommandLine(), error.getMessage() + "; see --help");
        return ExitCode.USAGE;
    }

    static int failure(Exception error, CommandLine command, ParseResult parsed) {
        LOG.debug("failed", error);
        if (error instanceof InvalidInputException) {
            print(command, error.getMessage());
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

    private static void print(CommandLine command, String message) {
        String line = message.strip().replaceAll("\\s*\\R\\s*", " | ");
        command.getErr().println(command.getCommandSpec().qualifiedName() + ": " + line);
    }
}
