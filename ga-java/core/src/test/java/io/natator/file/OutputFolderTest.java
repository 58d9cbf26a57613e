package io.natator.file;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeFalse;

import io.natator.base.InvalidInputException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class OutputFolderTest {

    @TempDir
    private Path folder;

    @Test
    void itIsMadeWithThoseThatItIsIn() {
        OutputFolder.make(folder.resolve("a/b"));
        OutputFolder.make(folder.resolve("a/b"));

        assertThat(folder.resolve("a/b")).isEmptyDirectory();
    }

    @Test
    void oneThatTakesNothingIsRefused() {
        Path closed = folder.resolve("closed");
        OutputFolder.make(closed);
        assertThat(closed.toFile().setWritable(false)).isTrue();
        assumeFalse(Files.isWritable(closed), "who may write anywhere cannot try it");

        assertThatThrownBy(() -> OutputFolder.make(closed)).isInstanceOf(InvalidInputException.class)
                .hasMessage("output folder " + closed + " cannot be written to");
    }
}
