package io.natator.cli;

import io.natator.file.ShellWord;
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
        return of(spec, "") + options(spec, without);
    }

    /** A command line with these options, each with a space before it. */
    static String of(CommandSpec spec, String options) {
        return "java -jar ga-java/target/natator.jar " + spec.name() + options;
    }

    /** The options that were given, each with a space before it. */
    static String options(CommandSpec spec, List<String> without) {
        StringBuilder command = new StringBuilder();
        for (OptionSpec option : spec.commandLine().getParseResult().matchedOptions()) {
            if (!without.contains(option.longestName())) {
                command.append(' ').append(option.longestName()).append(' ')
                        .append(ShellWord.of(String.join(",", option.originalStringValues())));
            }
        }
        return command.toString();
    }
}
