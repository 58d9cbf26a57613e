package io.natator.cli;

import java.util.List;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Model.OptionSpec;

/** A command line as a page shows it. */
final class CommandText {

    private CommandText() {
    }

    /**
     * The command line that was given.
     *
     * @param without options that do not change the outcome, left out
     */
    static String of(CommandSpec spec, List<String> without) {
        StringBuilder command = new StringBuilder("java -jar ga-java/target/natator.jar ").append(spec.name());
        for (OptionSpec option : spec.commandLine().getParseResult().matchedOptions()) {
            if (!without.contains(option.longestName())) {
                command.append(' ').append(option.longestName()).append(' ')
                        .append(String.join(",", option.originalStringValues()));
            }
        }
        return command.toString();
    }
}
