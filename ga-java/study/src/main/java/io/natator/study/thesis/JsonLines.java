package io.natator.study.thesis;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.Json;
import java.io.FileWriter;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.io.Writer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;

/**
 * Rows of a study in a file, one JSON value a line, each found by what was asked. A row is written as soon as it is
 * there; what a killed study left of a row is dropped at the next opening.
 */
final class JsonLines<T> implements AutoCloseable {

    private final Path file;
    private final Function<T, String> key;
    private final Map<String, T> rows = new LinkedHashMap<>();
    private Writer writer;

    /**
     * Reads the file, if it is there.
     *
     * @param key what a row is the answer to
     */
    JsonLines(Path file, Class<T> type, Function<T, String> key) {
        this.file = file;
        this.key = key;
        try {
            for (String line : Files.exists(file) ? Files.readAllLines(file) : List.<String>of()) {
                T row = parse(line, type);
                if (row != null) {
                    rows.put(key.apply(row), row);
                }
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + file + ": " + e.getMessage(), e);
        }
    }

    private static <T> T parse(String line, Class<T> type) {
        try {
            return Json.parse(line, type);
        } catch (JsonProcessingException e) {
            return null;
        }
    }

    /** The row that answers this, or null. */
    T find(String asked) {
        return rows.get(asked);
    }

    /** All rows, in the order in which they were added. */
    Collection<T> rows() {
        return rows.values();
    }

    /** Adds a row and hands it to the operating system. */
    void add(T row) {
        try {
            if (writer == null) {
                open();
            }
            writer.write(Json.line(row) + "\n");
            writer.flush();
            rows.put(key.apply(row), row);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + file + ": " + e.getMessage(), e);
        }
    }

    /** Whole rows only, then open for more. */
    private void open() throws IOException {
        Files.createDirectories(file.toAbsolutePath().getParent());
        Path fresh = file.resolveSibling(file.getFileName() + ".new");
        Files.write(fresh, rows.values().stream().map(Json::line).toList());
        Files.move(fresh, file, StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING);
        // No channel: that would be closed by an interrupt of the thread that writes.
        writer = new FileWriter(file.toFile(), StandardCharsets.UTF_8, true);
    }

    @Override
    public void close() {
        try {
            if (writer != null) {
                writer.close();
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot close " + file + ": " + e.getMessage(), e);
        }
    }
}
