package io.natator.file;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeFalse;

import io.natator.base.InvalidInputException;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class OutputFileTest {

    private static final byte[] CONTENT = "new".getBytes(StandardCharsets.UTF_8);

    @TempDir
    private Path folder;

    @Test
    void aFileIsReplaced() throws IOException {
        Path file = Files.writeString(folder.resolve("page.html"), "old");

        OutputFile.write(file, CONTENT);

        assertThat(file).hasContent("new");
        assertThat(folder.toFile().list()).containsExactly("page.html");
    }

    @Test
    void ofALinkTheTargetIsWritten() throws IOException {
        Path file = Files.createFile(folder.resolve("page.html"));
        Path near = Files.createSymbolicLink(folder.resolve("near"), Path.of("page.html"));
        Path far = Files.createSymbolicLink(folder.resolve("far"), near);

        OutputFile.write(far, CONTENT);
        assertThat(file).hasContent("new");

        OutputFile.write(near, "again".getBytes(StandardCharsets.UTF_8));
        assertThat(file).hasContent("again");
        assertThat(near).isSymbolicLink();
        assertThat(far).isSymbolicLink();
    }

    @Test
    void aFolderThatTakesNothingIsRefused() {
        assertThat(folder.toFile().setWritable(false)).isTrue();
        try {
            assumeFalse(Files.isWritable(folder), "who may write anywhere cannot try it");
            assertThatThrownBy(() -> OutputFile.check(folder.resolve("page.html")))
                    .isInstanceOf(InvalidInputException.class)
                    .hasMessageEndingWith("; expected a folder that can be written to, unlike " + folder);
        } finally {
            assertThat(folder.toFile().setWritable(true)).isTrue();
        }
    }

    @Test
    void whatIsNoFileIsLeftAlone() throws IOException, InterruptedException {
        Path pipe = folder.resolve("pipe");
        assertThat(new ProcessBuilder("mkfifo", pipe.toString()).start().waitFor()).isZero();
        Path link = Files.createSymbolicLink(folder.resolve("link"), Path.of("/dev/null"));

        for (Path file : new Path[] {pipe, link, Path.of("/dev/full")}) {
            assertThatThrownBy(() -> OutputFile.check(file)).isInstanceOf(InvalidInputException.class)
                    .hasMessage("output file is " + file
                            + ", which is a device or a pipe; expected the name of a file, new or to be replaced");
        }
        assertThatThrownBy(() -> OutputFile.check(folder)).hasMessageContaining("which is a folder");
        assertThatThrownBy(() -> OutputFile.check(folder.resolve("no/page.html")))
                .hasMessageContaining("expected a folder that exists, unlike " + folder.resolve("no"));
    }
}
