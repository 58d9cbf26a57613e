package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.Locale;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine;

/** The same words and numbers, whatever the user's language. */
class LocaleTest {

    private final Locale before = Locale.getDefault();

    @AfterEach
    void restore() {
        Locale.setDefault(before);
    }

    /** As after {@code java -jar}, of a folder that is called é; the second command has it as a text, not yet as a path. */
    @ParameterizedTest
    @ValueSource(strings = {"show", "page --simulator-path /bin/true"})
    void aNameThatJavaCannotReadIsToldInOneLine(String command) throws IOException, InterruptedException {
        ProcessBuilder java = new ProcessBuilder("sh", "-c",
                "LC_ALL=C exec \"$0\" -cp \"$1\" io.natator.cli.Main " + command
                        + " \"$(printf '\\303\\251')\"",
                Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                System.getProperty("java.class.path")).redirectErrorStream(true);
        java.environment().remove("JAVA_TOOL_OPTIONS");
        Process process = java.start();

        assertThat(new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8)).hasLineCount(1)
                .startsWith("natator " + command.replaceFirst(" .*", "") + ": ")
                .contains("'\ufffd\ufffd'");
        assertThat(process.waitFor()).isEqualTo(2);
    }

    @Test
    void numbersHaveTheSameDigitsEverywhere() {
        Locale.setDefault(Locale.forLanguageTag("ar-EG"));
        CommandLine command = Main.commandLine().setOut(new PrintWriter(new StringWriter()));

        Main.run(command, new String[] {"--version"});

        assertThat(String.format("generation %d: %.1f", 30, -0.5)).isEqualTo("generation 30: -0.5");
    }
}
