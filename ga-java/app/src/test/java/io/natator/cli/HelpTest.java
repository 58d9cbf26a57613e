package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;
import picocli.CommandLine;
import picocli.CommandLine.Model.OptionSpec;

class HelpTest {

    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    private int natator(String... arguments) {
        return Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true))
                .execute(arguments);
    }

    private static Stream<CommandLine> commands() {
        return Main.commandLine().getSubcommands().values().stream();
    }

    @ParameterizedTest
    @MethodSource("commands")
    void everyOptionIsListedOnceAndLongHelpHasHeadings(CommandLine command) {
        String help = command.getUsageMessage();

        List<OptionSpec> options = command.getCommandSpec().options();
        assertThat(options).allSatisfy(option -> assertThat(help.split("(?m)^ +(-., )?" + option.longestName() + "(?![\\w-])"))
                .as(option.longestName()).hasSize(2));
        if (options.size() > 8) {
            assertThat(help).contains("[OPTIONS]", "\nHow it is computed:\n", "natator "
                    + command.getCommandName() + " ");
            assertThat(help.contains("\nWhat swims:\n"))
                    .isEqualTo(options.stream().anyMatch(option -> option.longestName().matches("--(gait|scheme|scene|variants|water)")));
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

    /** Options that commands share say what is so in this one: nothing is resumed where nothing is. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
        "evolve|a GPU where there is one). Default: cpu; of a run that is resumed, its own.",
        "evolve|Simulated time, to the nearest frame. Default: the preset's, else the scene's (4 for the thesis scenes).",
        "evolve|How to solve: flex, conserving or lattice. Default: the scene's.",
        "resume|a GPU where there is one). Default: the run's.", "check|a GPU where there is one). Default: the run's.",
        "evaluate|a GPU where there is one). Default: cpu.",
        "compare|a GPU where there is one). Default: that of the runs, cpu if they have several.",
        "evaluate|Simulated time, to the nearest frame. Default: the scene's (4 for the thesis scenes).",
        "evaluate|How to solve: flex, conserving or lattice. Default: the scene's.",
        "page|Simulated time, to the nearest frame. Default: the run's, else the scene's (4 for the thesis scenes).",
        "page|How to solve: flex, conserving or lattice. Default: the run's, else the scene's."})
    void sharedOptionsHaveEachCommandsDefault(String command, String text) {
        String help = Main.commandLine().getSubcommands().get(command).getUsageMessage();

        assertThat(help.replaceAll("\\s+", " ")).contains(text);
    }

    @ParameterizedTest
    @MethodSource("commands")
    void noPlaceIsLeftForADefault(CommandLine command) {
        assertThat(command.getUsageMessage()).doesNotContain("{own", "default}");
    }

    @Test
    void evolveHasItsOptionsInGroupsAndExamples() {
        assertThat(natator("evolve", "--help")).isZero();

        assertThat(out.toString()).containsSubsequence("What swims:", "--creature", "How its gait is searched for:",
                "--fitness", "How much is done:", "--generations", "How it is computed:", "--workers",
                "What is written, and where:", "--output-dir", "Other options:", "--resume", "Examples:",
                "natator evolve --creature 2");
    }

    @Test
    void withoutACommandTheHelpSaysWhichThereAre() {
        assertThat(natator()).isEqualTo(2);

        assertThat(err.toString()).startsWith("Usage: natator [").contains("Commands:");
        assertThat(out.toString()).isEmpty();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
        "evolv|natator: 'evolv' is no command; did you mean evolve? See natator --help",
        "resum|natator: 'resum' is no command; did you mean resume? See natator --help",
        "swim|natator: 'swim' is no command; see natator --help",
        "view --crature=2|natator view: --crature is no option of this command; did you mean --creature? See natator view --help",
        "view --zzz|natator view: --zzz is no option of this command; see natator view --help"})
    void whatWasProbablyMeantIsNamed(String arguments, String line) {
        assertThat(natator(arguments.split(" "))).isEqualTo(2);
        assertThat(err.toString().strip()).isEqualTo(line);
    }
}
