package io.natator.study;

import io.natator.config.Json;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;

/** Comparisons as a table of comma-separated values, one line for each variant and interval. */
final class ComparisonTable {

    private static final String HEADER = "variant,about,medium,flex_runs,interval_s,"
            + "flex_n,flex_mean,flex_sd,ours_n,ours_mean,ours_sd,ours_as_stated,difference,spread,difference_in_spreads,standard_error";

    private ComparisonTable() {
    }

    static String csv(List<Comparison> comparisons) {
        return comparisons.stream().map(ComparisonTable::line).collect(Collectors.joining("\n", HEADER + "\n", "\n"));
    }

    private static String line(Comparison comparison) {
        Variant variant = comparison.variant();
        String runs = variant.flexRuns().stream().map(FlexRun::name).collect(Collectors.joining(" "));
        return String.join(",", variant.name(), Json.line(variant.about()), variant.inFluid() ? "fluid" : "vacuum", runs,
                number(comparison.interval().duration()),
                sample(comparison.flex()), sample(comparison.ours()), number(comparison.asStated()),
                number(comparison.difference()),
                number(comparison.spread()), number(comparison.differenceInSpreads()),
                number(comparison.standardError()));
    }

    private static String sample(Sample sample) {
        return sample.count() + "," + number(sample.mean()) + "," + number(sample.standardDeviation());
    }

    /** Five significant digits, as many as the measurements have; empty where there is no number. */
    private static String number(double value) {
        return Double.isFinite(value) ? String.format(Locale.ROOT, "%.5g", value) : "";
    }
}
