package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;
import picocli.CommandLine;
import picocli.CommandLine.Model.OptionSpec;

class HelpTest extends CommandTest {

    private static Stream<CommandLine> commands() {
        return Main.commandLine().getSubcommands().values().stream();
    }

    @ParameterizedTest
    @MethodSource("commands")
    void everyOptionIsListedOnceAndLongHelpHasHeadings(CommandLine command) {
        String help = command.getUsageMessage();

        List<OptionSpec> options = command.getCommandSpec().options();
        assertThat(options)
                .allSatisfy(option -> assertThat(help.split("(?m)^ +(-., )?" + option.longestName() + "(?![\\w-])"))
                        .as(option.longestName()).hasSize(2));
        if (options.size() > 8) {
            assertThat(help).contains("[OPTIONS]", "\nHow it is computed:\n", "natator "
                    + command.getCommandName() + " ");
            assertThat(help.contains("\nWhat swims:\n"))
                    .isEqualTo(options.stream()
                            .anyMatch(option -> option.longestName().matches("--(gait|scheme|scene|variants|water)")));
        }
        assertThat(help).as("paths in one piece").doesNotContainPattern("~[/.]*\\n");
        assertThat(help).doesNotContainPattern("\\([Tt]hesis \\d|eq\\. \\d");
    }

    /** What is copied from a help is a command: one line in the help is one line in the text. */
    @ParameterizedTest
    @MethodSource("commands")
    void examplesAreInOnePiece(CommandLine command) {
        List<String> footer = List.of(command.getCommandSpec().usageMessage().footer());

        assertThat(command.getUsageMessage().lines()).containsAll(footer);
    }

    @Test
    void withoutACommandTheHelpSaysWhichThereAre() {
        refused(execute()).startsWith("Usage: natator [").contains("Commands:",
                "\nExit status: 0 done, 1 failure, 2 bad usage or input, 130 Ctrl-C, 143 SIGTERM.\n");
        assertThat(out.toString()).isEmpty();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "evolv|natator: 'evolv' is no command; did you mean evolve or evaluate? See natator --help",
            "resum|natator: 'resum' is no command; did you mean resume or compare? See natator --help",
            "swim|natator: 'swim' is no command; see natator --help",
            "view --crature=2|natator view: --crature is no option of this command; did you mean --creature? See natator view --help",
            "view --zzz|natator view: --zzz is no option of this command; see natator view --help"})
    void whatWasProbablyMeantIsNamed(String arguments, String line) {
        refused(execute(arguments.split(" "))).isEqualTo(line + "\n");
    }
}
