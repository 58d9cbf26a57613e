package io.natator.cli;

import java.util.Arrays;
import java.util.List;
import java.util.Map;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Model.OptionSpec;

/** Shows the command's own default of shared options in its help. */
final class OwnDefaults {

    /** Placeholder in an option's description: the command's own default stands there. */
    static final String HERE = "{own default}";

    private static final String RUN = "the run's, else ";
    /** By option and command; the empty name is that of all others. */
    private static final Map<String, Map<String, String>> TEXTS = Map.of(
            "--backend", Map.of("", "cpu", "evolve", "cpu; of a run that is resumed, its own", "resume", "the run's", "check", "the run's",
                    "converge", "the run's", "compare", "that of the runs, cpu if they have several"),
            "--duration", Map.of("", "", "evolve", "the preset's, else ", "page", RUN),
            "--scheme", Map.of("", RUN, "evaluate", "", "evolve", ""));

    private OwnDefaults() {
    }

    /** For a command and all below it. */
    static void install(CommandLine command) {
        CommandSpec spec = command.getCommandSpec();
        for (OptionSpec option : List.copyOf(spec.options())) {
            Map<String, String> texts = TEXTS.get(option.longestName());
            if (texts != null) {
                String own = texts.getOrDefault(spec.name(), texts.get(""));
                String[] description = Arrays.stream(option.description()).map(line -> line.replace(HERE, own)).toArray(String[]::new);
                spec.remove(option);
                spec.addOption(OptionSpec.builder(option).description(description).build());
            }
        }
        command.getSubcommands().values().forEach(OwnDefaults::install);
    }
}
