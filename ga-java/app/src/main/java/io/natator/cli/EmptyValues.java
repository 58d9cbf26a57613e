package io.natator.cli;

import java.util.List;
import java.util.stream.Stream;
import picocli.CommandLine;
import picocli.CommandLine.IExecutionStrategy;
import picocli.CommandLine.Model.ArgSpec;
import picocli.CommandLine.Model.OptionSpec;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.ParseResult;

/** Refuses an empty value of whatever argument, which mostly is a variable of the shell that is not set. */
final class EmptyValues {

    private EmptyValues() {
    }

    /** Makes a command, and those below it, refuse them before they are carried out. */
    static void refuse(CommandLine command) {
        IExecutionStrategy usual = command.getExecutionStrategy();
        command.setExecutionStrategy(parsed -> {
            parsed.asCommandLineList().forEach(EmptyValues::check);
            return usual.execute(parsed);
        });
    }

    private static void check(CommandLine command) {
        ParseResult parsed = command.getParseResult();
        Stream<ArgSpec> given = Stream.<List<? extends ArgSpec>>of(parsed.matchedOptions(), parsed.matchedPositionals())
                .flatMap(List::stream);
        given.filter(one -> one.originalStringValues().contains("")).findFirst().ifPresent(one -> {
            String name = one instanceof OptionSpec option ? option.longestName() : one.paramLabel();
            throw new ParameterException(command,
                    name + " is empty; expected a value: is a variable of the shell not set?");
        });
    }
}
