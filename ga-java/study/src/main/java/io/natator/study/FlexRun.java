package io.natator.study;

import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * One run of NVIDIA Flex 1.2.0 in {@code tests/conformance/variants/variants.csv}.
 *
 * @param columns the line's values by column name; its README says what they mean
 */
record FlexRun(Map<String, String> columns) {

    /** Name of the run. */
    String name() {
        return columns.get("name");
    }

    /** Whether the body swam in fluid, not in vacuum. */
    boolean inFluid() {
        return columns.get("medium").equals("fluid");
    }

    /** Mean x velocity of the body between 0 s and the end of the interval, in scene units per second. */
    double speed(Interval interval) {
        return Double.parseDouble(columns.get(interval.flexColumn()));
    }

    /**
     * Reads all runs.
     *
     * @throws InvalidInputException if the file is missing or is not such a table
     */
    static List<FlexRun> readAll(Path csv) {
        List<String> lines;
        try {
            lines = Files.readAllLines(csv);
        } catch (IOException e) {
            throw new InvalidInputException("measurements " + csv + " cannot be read: " + e.getMessage(), e);
        }
        String[] header = lines.isEmpty() ? new String[0] : lines.get(0).split(",");
        List<String> required = new ArrayList<>(List.of("name", "medium"));
        Arrays.stream(Interval.values()).map(Interval::flexColumn).forEach(required::add);
        if (!Arrays.asList(header).containsAll(required)) {
            throw new InvalidInputException("measurements " + csv + ": expected columns " + required);
        }
        List<FlexRun> runs = new ArrayList<>();
        for (int line = 1; line < lines.size(); line++) {
            String[] values = lines.get(line).split(",", -1);
            if (values.length != header.length) {
                throw new InvalidInputException("measurements " + csv + ", line " + (line + 1) + ": " + values.length
                        + " values; expected " + header.length);
            }
            Map<String, String> columns = new LinkedHashMap<>();
            for (int column = 0; column < header.length; column++) {
                columns.put(header[column], values[column]);
            }
            runs.add(new FlexRun(columns));
        }
        return runs;
    }
}
