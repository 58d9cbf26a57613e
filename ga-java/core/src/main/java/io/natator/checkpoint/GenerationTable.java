package io.natator.checkpoint;

import io.natator.evolution.GenerationSummary;
import java.util.List;

/** {@code generations.csv}: one row per generation. Doubles have all their digits; nothing in it depends on time. */
final class GenerationTable {

    private static final String HEADER =
            "generation,best,mean,median,worst,population,evaluations,unstable,failed\n";

    private GenerationTable() {
    }

    static String csv(List<GenerationSummary> history) {
        StringBuilder csv = new StringBuilder(HEADER);
        for (GenerationSummary row : history) {
            csv.append(row.generation()).append(',').append(row.best()).append(',').append(row.mean()).append(',')
                    .append(row.median()).append(',').append(row.worst()).append(',').append(row.population())
                    .append(',').append(row.evaluations()).append(',').append(row.unstable()).append(',')
                    .append(row.failed()).append('\n');
        }
        return csv.toString();
    }
}
