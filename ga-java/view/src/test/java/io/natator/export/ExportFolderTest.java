package io.natator.export;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class ExportFolderTest {

    @TempDir
    private Path parent;
    private Path target;
    private Path partial;

    @BeforeEach
    void names() {
        target = parent.resolve("swim");
        partial = parent.resolve("swim.partial");
    }

    private void write(String content, boolean replace) throws IOException {
        try (ExportFolder folder = ExportFolder.begin(target, replace)) {
            Files.writeString(folder.path().resolve(ExportFolder.METADATA), content);
            assertThat(target.resolve(ExportFolder.METADATA)).as("before it is whole").satisfies(file ->
                    assertThat(!Files.exists(file) || !Files.readString(file).equals(content)).isTrue());
            folder.commit();
        }
    }

    @Test
    void appearsWhenItIsWhole() throws IOException {
        write("first", false);

        assertThat(target.resolve(ExportFolder.METADATA)).hasContent("first");
        assertThat(parent).isDirectoryNotContaining(path -> !path.equals(target));
        assertThat(target).isDirectoryNotContaining(path -> !path.endsWith(ExportFolder.METADATA));
    }

    @Test
    void leavesNothingWhenItFails() throws IOException {
        try (ExportFolder folder = ExportFolder.begin(target, false)) {
            Files.createDirectories(folder.path().resolve("water"));
            Files.writeString(folder.path().resolve("water").resolve("one"), "x");
        }
        assertThat(parent).isEmptyDirectory();
    }

    @Test
    void anEmptyFolderIsTaken() throws IOException {
        Files.createDirectories(target);
        write("first", false);

        assertThat(target.resolve(ExportFolder.METADATA)).hasContent("first");
    }

    @Test
    void anExportIsReplacedOnlyIfWanted() throws IOException {
        write("{\"files\":[\"metadata.json\",\"swim.csv\",\"water/1.ply\"]}", false);
        Files.writeString(target.resolve("swim.csv"), "of the first");
        Files.writeString(Files.createDirectories(target.resolve("water")).resolve("1.ply"), "of the first");

        assertThatThrownBy(() -> ExportFolder.begin(target, false)).isInstanceOf(InvalidInputException.class)
                .hasMessage("output folder " + target + " is not empty; choose another by --output-dir, or replace the "
                        + "export in it by --force");
        write("second", true);
        assertThat(target.resolve(ExportFolder.METADATA)).hasContent("second");
        assertThat(target.resolve("swim.csv")).doesNotExist();
        assertThat(parent).isDirectoryNotContaining(path -> !path.equals(target));
    }

    @Test
    void whatSomebodyPutBesideAnExportIsNotRemoved() throws IOException {
        write("{\"files\":[\"metadata.json\"]}", false);
        Path notes = Files.writeString(Files.createDirectories(target.resolve("figures")).resolve("notes.txt"), "mine");

        assertThatThrownBy(() -> ExportFolder.begin(target, true)).isInstanceOf(InvalidInputException.class)
                .hasMessage("output folder " + target + " holds figures/notes.txt, which is no part of the export in it; move it away, "
                        + "or choose another folder by --output-dir");
        assertThat(notes).hasContent("mine");
    }

    @Test
    void whatIsNoExportIsNeverReplaced() throws IOException {
        Files.createDirectories(target);
        Files.writeString(target.resolve("thesis.tex"), "years of work");

        assertThatThrownBy(() -> ExportFolder.begin(target, true)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("holds no export: it has no metadata.json");
        assertThat(target.resolve("thesis.tex")).hasContent("years of work");
    }

    @Test
    void whatAKilledExportLeftGoesWithTheNext() throws IOException {
        ExportFolder killed = ExportFolder.begin(target, false);
        Files.writeString(killed.path().resolve("half"), "x");
        assertThatThrownBy(() -> ExportFolder.begin(target, false)).isInstanceOf(InvalidInputException.class)
                .hasMessage("another export to " + target + " is being written");
        killed.close();
        Files.createDirectories(partial);
        Files.writeString(partial.resolve("export.lock"), "");
        Files.writeString(partial.resolve("half"), "x");

        write("next", false);

        assertThat(target.resolve("half")).doesNotExist();
        assertThat(partial).doesNotExist();
    }

    @Test
    void aFolderOfSomebodyElseIsNotRemoved() throws IOException {
        Files.createDirectories(partial);
        Files.writeString(partial.resolve("mine"), "x");

        assertThatThrownBy(() -> ExportFolder.begin(target, false)).isInstanceOf(InvalidInputException.class)
                .hasMessage(partial + " is in the way; remove it");
        assertThat(partial.resolve("mine")).exists();
    }

    @Test
    void whatHasTheNameThatTheReplacedExportGetsIsNotRemoved() throws IOException {
        write("{\"files\":[\"metadata.json\"]}", false);
        Path mine = Files.writeString(Files.createDirectories(parent.resolve("swim.replaced")).resolve("mine"), "x");

        assertThatThrownBy(() -> ExportFolder.begin(target, true)).isInstanceOf(InvalidInputException.class)
                .hasMessage(mine.getParent() + " is in the way; remove it");
        assertThat(mine).exists();
        assertThat(target.resolve(ExportFolder.METADATA)).exists();
        assertThat(partial).doesNotExist();
    }
}
