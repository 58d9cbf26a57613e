package io.natator.plot;

import io.natator.config.FileErrors;
import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/**
 * A study's results: rows of text under named columns, without quoted fields.
 *
 * @param columns names of the columns
 * @param rows    one field per column each
 */
record ResultTable(List<String> columns, List<List<String>> rows) {

    /**
     * Reads a CSV file.
     *
     * @param required columns that it must have
     * @throws InvalidInputException naming what is wrong
     */
    static ResultTable read(Path file, List<String> required) {
        List<String> lines;
        try {
            lines = Files.readAllLines(file);
        } catch (IOException e) {
            throw new InvalidInputException(file + ": cannot be read: " + FileErrors.reason(file, e), e);
        }
        List<String> columns = lines.isEmpty() ? List.of() : fields(lines.get(0));
        for (String name : required) {
            if (!columns.contains(name)) {
                throw new InvalidInputException(file + ": has no column " + name);
            }
        }
        List<List<String>> rows = new ArrayList<>();
        for (int i = 1; i < lines.size(); i++) {
            List<String> row = fields(lines.get(i));
            if (row.size() != columns.size()) {
                throw new InvalidInputException(file + ": line " + (i + 1) + " has " + row.size()
                        + " fields, expected " + columns.size());
            }
            rows.add(row);
        }
        return new ResultTable(columns, List.copyOf(rows));
    }

    String text(List<String> row, String column) {
        return row.get(columns.indexOf(column));
    }

    /**
     * A field as a number.
     *
     * @throws InvalidInputException if it is none
     */
    double number(List<String> row, String column) {
        try {
            return Double.parseDouble(text(row, column));
        } catch (NumberFormatException e) {
            throw new InvalidInputException(column + " is \"" + text(row, column) + "\": must be a number", e);
        }
    }

    /** The rows whose columns, given as name and value in turn, hold these values. */
    ResultTable where(String... namesAndValues) {
        List<List<String>> chosen = rows;
        for (int i = 0; i < namesAndValues.length; i += 2) {
            String name = namesAndValues[i];
            String value = namesAndValues[i + 1];
            chosen = chosen.stream().filter(row -> text(row, name).equals(value)).toList();
        }
        return new ResultTable(columns, chosen);
    }

    /** What a column holds, each value once, in the order of its first row. */
    List<String> distinct(String column) {
        return rows.stream().map(row -> text(row, column)).distinct().toList();
    }

    private static List<String> fields(String line) {
        return List.of(line.split(",", -1));
    }
}
