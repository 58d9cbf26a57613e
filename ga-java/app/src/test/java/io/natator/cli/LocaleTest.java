package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.Locale;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import picocli.CommandLine;

/** The same words and numbers, whatever the user's language. */
class LocaleTest {

    private final Locale before = Locale.getDefault();

    @AfterEach
    void restore() {
        Locale.setDefault(before);
    }

    @Test
    void numbersHaveTheSameDigitsEverywhere() {
        Locale.setDefault(Locale.forLanguageTag("ar-EG"));
        CommandLine command = Main.commandLine().setOut(new PrintWriter(new StringWriter()));

        Main.run(command, new String[] {"--version"});

        assertThat(String.format("generation %d: %.1f", 30, -0.5)).isEqualTo("generation 30: -0.5");
    }
}
