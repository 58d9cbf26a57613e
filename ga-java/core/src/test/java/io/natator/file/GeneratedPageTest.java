package io.natator.file;

import static org.assertj.core.api.Assertions.assertThatCode;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Which folders results may be written to. */
class GeneratedPageTest {

    @TempDir
    private Path folder;

    @Test
    void aNewFolderAndOneWithAGeneratedPageAreTaken() throws IOException {
        assertThatCode(() -> GeneratedPage.check(folder.resolve("new"))).doesNotThrowAnyException();
        assertThatCode(() -> GeneratedPage.check(folder)).doesNotThrowAnyException();
        Files.writeString(folder.resolve("README.md"), "# Results\n\n" + GeneratedPage.MARK + " Made with\n");
        assertThatCode(() -> GeneratedPage.check(folder)).doesNotThrowAnyException();
    }

    @Test
    void aPageOfSomebodysOwnIsNotOverwritten() throws IOException {
        Files.writeString(folder.resolve("README.md"), "# My notes\n");

        assertThatThrownBy(() -> GeneratedPage.check(folder)).isInstanceOf(InvalidInputException.class)
                .hasMessage("output folder " + folder + " has a README.md that natator did not write; choose another by --output-dir");
    }

    @Test
    void aFileIsNoFolder() throws IOException {
        Path file = Files.writeString(folder.resolve("results"), "");

        assertThatThrownBy(() -> GeneratedPage.check(file)).isInstanceOf(InvalidInputException.class)
                .hasMessage("output folder " + file + " is a file; choose another by --output-dir");
    }
}
