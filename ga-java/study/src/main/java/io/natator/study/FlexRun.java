package io.natator.study;

import io.natator.config.InvalidInputException;
import io.natator.file.CsvReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.function.Function;
import java.util.stream.Collectors;
import java.util.stream.Stream;

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
        List<String> required = Stream.concat(Stream.of("name", "medium"),
                Arrays.stream(Interval.values()).map(Interval::flexColumn)).toList();
        List<FlexRun> runs = new ArrayList<>();
        try (CsvReader table = new CsvReader(csv, required)) {
            while (table.next()) {
                runs.add(new FlexRun(table.columns().stream().collect(Collectors.toMap(Function.identity(), table::text))));
            }
        }
        return runs;
    }
}
