package io.natator.export;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.attribute.PosixFilePermissions;
import java.util.List;
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

    /** Whoever made it for others to read, or to write, finds it so. */
    @Test
    void anEmptyFolderIsFilledAndStaysItself() throws IOException {
        Files.createDirectories(target);
        Files.setPosixFilePermissions(target, PosixFilePermissions.fromString("rwxrwx--x"));
        Object before = Files.getAttribute(target, "unix:ino");

        try (ExportFolder folder = ExportFolder.begin(target, false)) {
            Files.writeString(Files.createDirectories(folder.path().resolve("water")).resolve("1.ply"), "x");
            Files.writeString(folder.path().resolve(ExportFolder.METADATA), "first");
            assertThat(target).isEmptyDirectory();
            folder.commit();
        }

        assertThat(ExportFolder.files(target)).containsExactly(ExportFolder.METADATA, "water/1.ply");
        assertThat(target.resolve(ExportFolder.METADATA)).hasContent("first");
        assertThat(Files.getAttribute(target, "unix:ino")).isEqualTo(before);
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(target))).isEqualTo("rwxrwx--x");
        assertThat(parent).isDirectoryNotContaining(path -> !path.equals(target));
    }

    /** What somebody puts into the folder meanwhile stays, and nothing of the export comes between. */
    @Test
    void anEmptyFolderThatCannotBeFilledStaysEmpty() throws IOException {
        Files.createDirectories(target);
        try (ExportFolder folder = ExportFolder.begin(target, false)) {
            Files.writeString(folder.path().resolve("a.csv"), "x");
            Files.writeString(folder.path().resolve(ExportFolder.METADATA), "{\"files\":[\"a.csv\",\"metadata.json\",\"swim.csv\"]}");
            Path swim = Files.writeString(folder.path().resolve("swim.csv"), "x");
            Path obstacle = Files.createDirectories(target.resolve("swim.csv"));
            Files.writeString(obstacle.resolve("notes.txt"), "mine");

            assertThatThrownBy(() -> ExportFilling.fill(folder.path(), target)).isInstanceOf(IOException.class);

            assertThat(ExportFolder.files(target)).containsExactly("swim.csv/notes.txt");
            assertThat(swim).exists();
        }
    }

    /** Killed between two of its files: what it had moved goes, what is somebody's own stays. */
    @Test
    void whatAnExportThatWasKilledWhileItFilledTheFolderLeftGoesWithTheNext() throws IOException {
        Files.writeString(Files.createDirectories(target.resolve("water")).resolve("1.ply"), "moved");
        Files.writeString(Files.createDirectories(partial).resolve("export.lock"), "");
        Files.writeString(partial.resolve("swim.csv"), "not moved");
        Files.writeString(partial.resolve(ExportFolder.METADATA), "{\"files\":[\"metadata.json\",\"swim.csv\",\"water/1.ply\"]}");
        Path mine = Files.writeString(target.resolve("swim.csv"), "mine");

        assertThatThrownBy(() -> ExportFolder.begin(target, false)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("is not empty");
        assertThat(mine).hasContent("mine");
        assertThat(ExportFolder.files(target)).containsExactly("swim.csv");
        Files.delete(mine);

        write("next", false);
        assertThat(ExportFolder.files(target)).containsExactly(ExportFolder.METADATA);
        assertThat(parent).isDirectoryNotContaining(path -> !path.equals(target));
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

    /** An export may take an hour. */
    @Test
    void whatSomebodyPutIntoTheFolderMeanwhileIsNotRemoved() throws IOException {
        for (boolean isThere : List.of(true, false)) {
            if (isThere) {
                write("{\"files\":[\"metadata.json\"]}", false);
            }
            try (ExportFolder folder = ExportFolder.begin(target, true)) {
                Files.writeString(folder.path().resolve(ExportFolder.METADATA), "next");
                Path notes = Files.writeString(Files.createDirectories(target).resolve("notes.txt"), "mine");

                assertThatThrownBy(folder::commit).isInstanceOf(InvalidInputException.class)
                        .hasMessageContaining(isThere ? "holds notes.txt, which is no part" : "holds no export");
                assertThat(notes).hasContent("mine");
                Files.delete(notes);
            }
            assertThat(parent.resolve("swim.replaced")).doesNotExist();
            assertThat(partial).doesNotExist();
            Files.deleteIfExists(target.resolve(ExportFolder.METADATA));
            Files.deleteIfExists(target);
        }
    }

    @Test
    void anExportThatCameMeanwhileStaysUnlessForced() throws IOException {
        try (ExportFolder folder = ExportFolder.begin(target, false)) {
            Files.writeString(folder.path().resolve(ExportFolder.METADATA), "next");
            Files.writeString(Files.createDirectories(target).resolve(ExportFolder.METADATA), "{\"files\":[\"metadata.json\"]}");

            assertThatThrownBy(folder::commit).isInstanceOf(InvalidInputException.class).hasMessageContaining("by --force");
            assertThat(target.resolve(ExportFolder.METADATA)).content().contains("files");
        }
    }

    @Test
    void anExportIsBackWhereTheNextCannotTakeItsPlace() throws IOException {
        write("{\"files\":[\"metadata.json\"]}", false);
        try (ExportFolder folder = ExportFolder.begin(target, true)) {
            Files.delete(partial.resolve(ExportFolder.LOCK));
            Files.delete(partial);

            assertThatThrownBy(folder::commit).isInstanceOf(IOException.class);
        }
        assertThat(target.resolve(ExportFolder.METADATA)).content().contains("files");
        assertThat(parent).isDirectoryNotContaining(path -> !path.equals(target));
        assertThat(target).isDirectoryNotContaining(path -> !path.endsWith(ExportFolder.METADATA));
    }

    /** Killed when the earlier export had lost its name, and the next did not have it yet. */
    @Test
    void anExportThatAKillLeftWithoutItsNameIsBackWithTheNext() throws IOException {
        write("{\"files\":[\"metadata.json\"]}", false);
        new ReplacedExport(target).setAside();
        Files.writeString(Files.createDirectories(partial).resolve(ExportFolder.LOCK), "");
        Files.writeString(partial.resolve(ExportFolder.METADATA), "of the killed one");

        assertThatThrownBy(() -> ExportFolder.begin(target, false)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("by --force");
        assertThat(target.resolve(ExportFolder.METADATA)).content().contains("files");
        write("next", true);
        assertThat(target.resolve(ExportFolder.METADATA)).hasContent("next");
        assertThat(parent).isDirectoryNotContaining(path -> !path.equals(target));
    }

    /** Killed when the next had its name, and the earlier export was not removed yet. */
    @Test
    void anExportThatAKillLeftBesideTheNextGoesWithTheOneAfterIt() throws IOException {
        String listed = "{\"files\":[\"metadata.json\"]}";
        write(listed, false);
        new ReplacedExport(target).setAside();
        Files.writeString(Files.createDirectories(target).resolve(ExportFolder.LOCK), "");
        Files.writeString(target.resolve(ExportFolder.METADATA), listed);

        write("last", true);
        assertThat(target.resolve(ExportFolder.METADATA)).hasContent("last");
        assertThat(parent).isDirectoryNotContaining(path -> !path.equals(target));
    }

    @Test
    void whatIsNoExportIsNeverReplaced() throws IOException {
        Files.createDirectories(target);
        Files.writeString(target.resolve("thesis.tex"), "years of work");

        for (boolean replace : List.of(true, false)) {
            assertThatThrownBy(() -> ExportFolder.begin(target, replace)).isInstanceOf(InvalidInputException.class)
                    .hasMessageContaining("holds no export: it has no metadata.json").hasMessageNotContaining("--force");
        }
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
