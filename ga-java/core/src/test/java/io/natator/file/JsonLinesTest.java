package io.natator.file;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.base.InvalidInputException;
import java.io.IOException;
import java.io.RandomAccessFile;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.Arrays;
import java.util.List;
import java.util.stream.IntStream;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class JsonLinesTest {

    @TempDir
    private Path folder;
    private Path file;

    record Row(int number, String text) {
    }

    @BeforeEach
    void name() {
        file = folder.resolve("below/rows.jsonl");
    }

    private JsonLines<Row> lines() {
        return JsonLines.of(file, Row.class);
    }

    private void write(Row... rows) {
        try (JsonLines<Row> lines = lines()) {
            List.of(rows).forEach(lines::append);
        }
    }

    @Test
    void nothingIsMadeBeforeTheFirstRow() {
        try (JsonLines<Row> lines = lines()) {
            assertThat(lines.rows()).isEmpty();
            assertThat(file.getParent()).doesNotExist();
            lines.append(new Row(1, "ö\n"));
            assertThat(JsonLines.read(file, Row.class)).as("at once").containsExactly(new Row(1, "ö\n"));
        }
        write(new Row(2, ""));
        assertThat(JsonLines.read(file, Row.class)).containsExactly(new Row(1, "ö\n"), new Row(2, ""));
    }

    /** Every byte at which a writer can have been killed. */
    @Test
    void theNextRowTakesThePlaceOfOneThatWasCutShort() throws IOException {
        write(new Row(1, "ö"), new Row(2, "ö"));
        byte[] whole = Files.readAllBytes(file);
        int first = whole.length / 2;
        for (boolean locked : new boolean[] {false, true}) {
            for (int end = first; end < whole.length; end++) {
                Files.write(file, Arrays.copyOf(whole, end));
                try (JsonLines<Row> lines = locked ? JsonLines.locked(file, Row.class) : lines()) {
                    assertThat(lines.rows()).hasSize(1);
                    lines.append(new Row(2, "ö"));
                }
                assertThat(Files.readAllBytes(file)).as("cut to %d bytes", end).isEqualTo(whole);
            }
        }
    }

    @Test
    void aDamagedLineIsNamed() throws IOException {
        write(new Row(1, "a"));
        Files.writeString(file, "{}\n", StandardOpenOption.APPEND);
        String before = Files.readString(file);

        assertRefused(this::lines, ", line 2: ");
        assertRefused(() -> JsonLines.locked(file, Row.class), ", line 2: ");
        assertThat(file).hasContent(before);
    }

    private void assertRefused(ThrowingCallable use, String message) {
        assertThatThrownBy(use).isInstanceOf(InvalidInputException.class).hasMessageStartingWith(file + message);
    }

    /** Lines that lie across what is read at a time, and a line that nobody wrote, as of a file that was made larger. */
    @Test
    void longFilesAreReadByLines() throws IOException {
        Row[] all = IntStream.range(0, 300).mapToObj(i -> new Row(i, "ö".repeat(i * 7))).toArray(Row[]::new);
        write(all);
        for (boolean locked : new boolean[] {false, true}) {
            try (JsonLines<Row> lines = locked ? JsonLines.locked(file, Row.class) : lines()) {
                assertThat(lines.rows()).containsExactly(all);
                lines.append(new Row(300, "end"));
            }
            try (JsonLines<Row> lines = JsonLines.locked(file, Row.class)) {
                lines.dropFrom(300);
            }
        }
        try (RandomAccessFile larger = new RandomAccessFile(file.toFile(), "rw")) {
            larger.setLength(3L << 30);
        }
        assertRefused(this::lines, ", line 301 is longer than 16777216 bytes");
        assertRefused(() -> JsonLines.locked(file, Row.class), ", line 301 is longer than 16777216 bytes");
    }

    @Test
    void onlyOneWrites() {
        write(new Row(1, "a"));
        try (JsonLines<Row> early = lines(); JsonLines<Row> late = lines()) {
            early.append(new Row(2, "b"));

            assertRefused(() -> late.append(new Row(3, "c")), " is in use by another run");
            assertRefused(() -> JsonLines.locked(file, Row.class), " is in use by another run");
        }
        try (JsonLines<Row> late = lines()) {
            write(new Row(4, "d"));

            assertRefused(() -> late.append(new Row(5, "e")), " was changed by another run meanwhile");
        }
        assertThat(JsonLines.read(file, Row.class)).extracting(Row::number).containsExactly(1, 2, 4);
    }

    @Test
    void whatWasMadeForNoRowIsRemoved() throws IOException {
        Files.createDirectories(file.getParent());
        JsonLines<Row> lines = JsonLines.locked(file, Row.class);
        assertThat(file).as("its lock keeps others out").exists();
        lines.close();
        assertThat(file).doesNotExist();

        Files.createFile(file);
        lines.close();
        JsonLines.locked(file, Row.class).close();
        assertThat(file).as("somebody else's").exists();
    }

    @Test
    void rowsAreDroppedFromTheEnd() {
        write(new Row(1, "öö"), new Row(2, "b"), new Row(3, "c"));
        try (JsonLines<Row> lines = JsonLines.locked(file, Row.class)) {
            lines.dropFrom(1);
            assertThat(lines.size()).isEqualTo(1);
            lines.append(new Row(4, "d"));
            assertThat(lines.size()).isEqualTo(2);
        }
        assertThat(JsonLines.read(file, Row.class)).extracting(Row::number).containsExactly(1, 4);
    }
}
