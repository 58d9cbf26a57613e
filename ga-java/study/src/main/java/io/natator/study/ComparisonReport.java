package io.natator.study;

import io.natator.config.Numbers;
import io.natator.file.GeneratedPage;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.function.ToDoubleFunction;
import java.util.stream.Collectors;

/** Comparisons as a page to read: how it was made, what the numbers mean, a summary and a table. */
final class ComparisonReport {

    private static final String PAGE = """
            # Swimming speeds beside NVIDIA Flex 1.2.0

            %s Made with

            ```
            %s
            ```

            after `mvn package`, from the list in `%s` and the measurements in `tests/conformance/variants/`.
            `environment.json` says where, `evaluations.jsonl` holds every single run, `comparison.csv` this table with all
            its digits. Running the command again continues an interrupted study.

            ## How to read it
            Speeds are the mean x velocity of the body in scene units per second, as mean ± standard deviation (number of
            runs). Flex' runs differ by themselves, ours by random shifts of all starting positions by at most 1e-6. *As
            stated* is our run without a shift, from the start that Flex' runs have; it repeats to the last bit, and keeps the
            symmetries of the start, which shifts break, until rounding breaks them. The scene
            is the thesis' unless the row says otherwise; planes do not stop a run here. Δ is our mean minus Flex' mean in
            units of √(s_flex² + s_ours²), the spread that the difference of two single runs has. Where Flex ran only once, its
            spread is not known and is taken to be ours. With five runs on both sides the means themselves are known to 0.45
            of that spread, so |Δ| above about 1 shows a difference; with one run of Flex, |Δ| above about 2. In vacuum runs
            hardly differ, so Δ there counts rounding; look at the speeds. *Of the speeds* is the root mean square of the
            differences by that of Flex' speeds.

            ## Summary
            %s
            ## In fluid
            %s
            ![in fluid](comparison-fluid.png)

            ## In vacuum
            %s
            ![in vacuum](comparison-vacuum.png)
            """;

    private ComparisonReport() {
    }

    /**
     * The page in Markdown.
     *
     * @param command      what made the comparisons
     * @param variantsFile where the list of variants is
     */
    static String markdown(List<Comparison> comparisons, String command, String variantsFile) {
        List<Comparison> fluid = comparisons.stream().filter(one -> one.variant().inFluid()).toList();
        List<Comparison> vacuum = comparisons.stream().filter(one -> !one.variant().inFluid()).toList();
        return PAGE.formatted(GeneratedPage.MARK, command, variantsFile, summary("in fluid", fluid) + summary("in vacuum", vacuum),
                table(fluid), table(vacuum));
    }

    /** A line for each scene, which is a creature's. */
    private static String summary(String medium, List<Comparison> comparisons) {
        return comparisons.stream().map(one -> one.variant().scene()).distinct().sorted()
                .map(scene -> summaryLine(scene + " " + medium,
                        comparisons.stream().filter(one -> one.variant().scene().equals(scene)).toList()))
                .collect(Collectors.joining());
    }

    private static String summaryLine(String name, List<Comparison> comparisons) {
        double[] differences = comparisons.stream().mapToDouble(one -> Math.abs(one.difference())).sorted().toArray();
        long nearer = comparisons.stream()
                .filter(one -> Math.abs(one.differenceAsStated()) < Math.abs(one.difference())).count();
        return String.format(Locale.ROOT,
                "- %s: %d comparisons; |Δ| ≤ 1 in %d, ≤ 2 in %d, ≤ 3 in %d; absolute difference of the speeds: median %.4f, "
                        + "largest %.4f; %.1f %% of the speeds, as stated %s %%; the run as stated is nearer than the mean in "
                        + "%d%n", name, comparisons.size(), within(1, comparisons), within(2, comparisons),
                within(3, comparisons), differences[differences.length / 2], differences[differences.length - 1],
                100 * relative(comparisons, Comparison::difference),
                shown("%.1f", 100 * relative(comparisons, Comparison::differenceAsStated)), nearer);
    }

    private static double relative(List<Comparison> comparisons, ToDoubleFunction<Comparison> difference) {
        double squares = comparisons.stream().mapToDouble(difference).map(value -> value * value).sum();
        return Math.sqrt(squares / comparisons.stream().mapToDouble(one -> one.flex().mean() * one.flex().mean()).sum());
    }

    private static long within(double spreads, List<Comparison> comparisons) {
        return comparisons.stream().filter(one -> Math.abs(one.differenceInSpreads()) <= spreads).count();
    }

    private static String table(List<Comparison> comparisons) {
        String columns = Arrays.stream(Interval.values())
                .map(interval -> "Flex " + interval.label() + " | ours " + interval.label() + " | as stated | Δ |")
                .collect(Collectors.joining(" "));
        String alignment = "--- | --- |" + " ---: | ---: | ---: | ---: |".repeat(Interval.values().length);
        return "| variant | what differs | " + columns + "\n| " + alignment + "\n"
                + comparisons.stream().map(Comparison::variant).distinct()
                        .map(variant -> row(variant, comparisons)).collect(Collectors.joining());
    }

    private static String row(Variant variant, List<Comparison> comparisons) {
        String cells = Arrays.stream(Interval.values())
                .map(interval -> comparisons.stream()
                        .filter(one -> one.variant() == variant && one.interval() == interval).findFirst()
                        .map(one -> shown(one.flex()) + " | " + shown(one.ours()) + " | " + shown("%.4f", one.asStated())
                                + " | " + shown("%+.1f", one.differenceInSpreads()))
                        .orElse("| | |"))
                .collect(Collectors.joining(" | "));
        return "| " + variant.name() + " | " + variant.about() + " | " + cells + " |\n";
    }

    private static String shown(Sample sample) {
        String mean = sample.hasSpread() ? Numbers.withError(sample.mean(), sample.standardDeviation(), 4)
                : shown("%.4f", sample.mean());
        return mean + " (" + sample.count() + ")";
    }

    private static String shown(String format, double value) {
        return Double.isFinite(value) ? String.format(Locale.ROOT, format, value) : "–";
    }
}
