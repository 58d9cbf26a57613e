package io.natator.file;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.MappingIterator;
import com.fasterxml.jackson.dataformat.csv.CsvMapper;
import com.fasterxml.jackson.dataformat.csv.CsvParser;
import io.natator.base.InvalidInputException;
import io.natator.base.Numbers;
import io.natator.config.FileErrors;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/** Reads a CSV file row by row; its first line names the columns. All errors name the file, most also the line. */
public final class CsvReader implements AutoCloseable {

    private static final CsvMapper MAPPER =
            CsvMapper.csvBuilder().enable(CsvParser.Feature.WRAP_AS_ARRAY).build();

    private final Path file;
    private final MappingIterator<String[]> lines;
    private final List<String> columns;
    private final Map<String, Integer> places = new HashMap<>();
    private int line;
    private String[] row;

    /**
     * Opens a file.
     *
     * @param required columns that it must have
     * @throws InvalidInputException if it cannot be read or has no such columns
     */
    public CsvReader(Path file, List<String> required) {
        this.file = file;
        try {
            lines = MAPPER.readerFor(String[].class).readValues(Files.newBufferedReader(file));
        } catch (IOException e) {
            throw unreadable(e);
        }
        try {
            columns = advance() ? List.of(row) : List.of();
            columns.forEach(name -> places.put(name, places.size()));
            for (String name : required) {
                if (!places.containsKey(name)) {
                    throw new InvalidInputException(file + " has no column " + name);
                }
            }
        } catch (InvalidInputException e) {
            close();
            throw e;
        }
    }

    private InvalidInputException unreadable(IOException e) {
        return new InvalidInputException(file + " cannot be read: " + FileErrors.reason(file, e), e);
    }

    private boolean advance() {
        line++;
        try {
            if (!lines.hasNextValue()) {
                return false;
            }
            row = lines.nextValue();
            return true;
        } catch (JsonProcessingException e) {
            throw new InvalidInputException(file + ", line " + line + ": " + e.getOriginalMessage(), e);
        } catch (IOException e) {
            throw unreadable(e);
        }
    }

    /** Names of the columns. */
    public List<String> columns() {
        return columns;
    }

    /**
     * Goes on to the next row.
     *
     * @return whether there is one
     * @throws InvalidInputException if it has more or fewer fields than there are columns
     */
    public boolean next() {
        if (!advance()) {
            return false;
        }
        if (row.length != columns.size()) {
            throw new InvalidInputException(file + ", line " + line + " has " + Numbers.count(row.length, "field") + "; expected "
                    + columns.size());
        }
        return true;
    }

    /** The fields of this row, in the order of the columns. */
    public List<String> fields() {
        return List.of(row);
    }

    /** A field of this row. */
    public String text(String column) {
        return row[places.get(column)];
    }

    /**
     * A field of this row as a number.
     *
     * @throws InvalidInputException if it is none
     */
    public double number(String column) {
        try {
            return Double.parseDouble(text(column));
        } catch (NumberFormatException e) {
            throw new InvalidInputException(file + ", line " + line + ": " + column + " is \"" + text(column)
                    + "\"; expected a number", e);
        }
    }

    @Override
    public void close() {
        try {
            lines.close();
        } catch (IOException e) {
            throw unreadable(e);
        }
    }
}
