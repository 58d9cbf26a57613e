package io.natator.file;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class ShellWordTest {

    @Test
    void isQuotedOnlyWhereNeeded() {
        assertThat(ShellWord.of(Path.of("runs/creature-1_seed-1.json"))).isEqualTo("runs/creature-1_seed-1.json");
        assertThat(ShellWord.of("distance=1,work=0.5")).isEqualTo("distance=1,work=0.5");
        assertThat(ShellWord.of("m\u00f6we/\u6d77\u8c5a.json")).isEqualTo("m\u00f6we/\u6d77\u8c5a.json");
        assertThat(ShellWord.of("runs/minnow one")).isEqualTo("'runs/minnow one'");
    }

    @ParameterizedTest
    @ValueSource(strings = {"minnow one", "it's", "a\"b", "$HOME", "~", "a;b", "a*", "`ls`", "", "č", "a\\b", "a\nb",
            "#a", "!a", "{a,b}"})
    void aShellReadsItAsOneWord(String word) throws IOException, InterruptedException {
        Process shell = new ProcessBuilder("sh", "-c", "printf %s " + ShellWord.of(word)).start();
        assertThat(new String(shell.getInputStream().readAllBytes(), StandardCharsets.UTF_8)
                .replaceAll("[^\\x00-\\x7f]+", "?")).isEqualTo(word.replaceAll("[^\\x00-\\x7f]+", "?"));
        assertThat(shell.waitFor()).isZero();
    }
}
