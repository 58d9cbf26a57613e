package io.natator.plot;

import io.natator.config.InvalidInputException;
import io.natator.file.CsvReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/**
 * A study's results: rows of text under named columns.
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
        try (CsvReader table = new CsvReader(file, required)) {
            List<List<String>> rows = new ArrayList<>();
            while (table.next()) {
                rows.add(table.fields());
            }
            return new ResultTable(table.columns(), List.copyOf(rows));
        }
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
}
