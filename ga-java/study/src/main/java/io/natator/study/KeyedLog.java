package io.natator.study;

import io.natator.file.JsonLines;
import java.nio.file.Path;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.function.Function;
import java.util.function.Predicate;

/** Rows of a study in a file of JSON lines, each found by what was asked. The file is made with the first row. */
public final class KeyedLog<T> implements AutoCloseable {

    private final JsonLines<T> lines;
    private final Function<T, String> key;
    private final Map<String, T> rows = new LinkedHashMap<>();

    /**
     * Reads the file, if it is there.
     *
     * @param key what a row is the answer to
     * @throws io.natator.config.InvalidInputException if it is damaged
     */
    public KeyedLog(Path file, Class<T> type, Function<T, String> key) {
        this.lines = JsonLines.of(file, type);
        this.key = key;
        lines.rows().forEach(this::put);
    }

    private void put(T row) {
        rows.put(key.apply(row), row);
    }

    /**
     * Drops all rows but these, before any is added.
     *
     * @return how many were dropped
     */
    public int keep(Predicate<T> wanted) {
        int dropped = lines.keep(wanted);
        rows.values().removeIf(wanted.negate());
        return dropped;
    }

    /** The row that answers this, or null. */
    public T find(String asked) {
        return rows.get(asked);
    }

    /** All rows, in the order in which they were added. */
    public Collection<T> rows() {
        return rows.values();
    }

    /** Adds a row and hands it to the operating system. */
    public void add(T row) {
        lines.append(row);
        put(row);
    }

    @Override
    public void close() {
        lines.close();
    }
}
