package io.natator.study.cluster;

import io.natator.config.Numbers;
import io.natator.file.AtomicFile;
import io.natator.file.GeneratedPage;
import io.natator.plot.Picture;
import io.natator.simulator.PartSize;
import io.natator.study.Sample;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.OptionalDouble;
import java.util.stream.DoubleStream;
import java.util.stream.LongStream;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.style.Styler;

/** Efficiency of clusters of 10 to 10 000 executors for several loads: {@code efficiency.csv}, a picture and a page. */
public final class ClusterStudy {

    private static final int[] EXECUTORS = {10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000};
    private static final int REPEATS = 5;
    /** Where a cluster is taken to be badly used. */
    private static final double ENOUGH = 0.8;
    private static final double TENTH = 0.1;
    private static final double SLOW = 30;

    private final Assumptions cluster;
    private final double[] times;
    private final long seed;

    /** A curve: a load, under assumptions of its own. */
    private record Variant(String name, Load load, Assumptions cluster) {
    }

    /** Of a variant on so many executors: what came of each repeat. */
    private record Point(Variant variant, int executors, List<Usage> usages) {

        Sample efficiency() {
            return Sample.of(usages.stream().map(Usage::efficiency).toList());
        }
    }

    /**
     * A study.
     *
     * @param times that evaluations take, s
     * @param seed  of the first of the repeats
     */
    public ClusterStudy(Assumptions cluster, double[] times, long seed) {
        this.cluster = cluster;
        this.times = times.clone();
        this.seed = seed;
    }

    /**
     * Carries it out.
     *
     * @param command what to write on the page as its origin
     * @return the page
     * @throws IOException if something cannot be written
     */
    public Path writeTo(Path folder, String command) throws IOException {
        List<List<Point>> curves = variants().stream().map(this::curve).toList();
        AtomicFile.write(folder.resolve("efficiency.csv"), csv(curves));
        Picture.save(chart(curves), folder.resolve("efficiency"));
        Path page = folder.resolve(GeneratedPage.NAME);
        AtomicFile.write(page, page(curves, command));
        return page;
    }

    private List<Variant> variants() {
        Load one = new Load(150, 1, 20);
        Load eightStarts = new Load(1200, 1, 10);
        Load side = new Load(150, 32, 10);
        Load sideStarts = new Load(1200, 32, 3);
        return List.of(new Variant("one run, 150 gaits", one, cluster),
                new Variant("one run, 150 gaits, if nothing else took time or failed", one, Assumptions.IDEAL),
                new Variant("one run, 150 gaits × 8 starts", eightStarts, cluster),
                new Variant("one run, 150 gaits × 8 starts, slow ones 30 times as slow", eightStarts, cluster.withSlowFactor(SLOW)),
                new Variant("one run, 150 gaits × 8 starts, 30 times, no second tries", eightStarts, cluster.withSlowFactor(SLOW).withSpeculation(false)),
                new Variant("32 runs at once, 150 gaits", side, cluster),
                new Variant("32 runs at once, 150 gaits × 8 starts", sideStarts, cluster),
                new Variant("32 runs at once, 150 gaits × 8 starts, a tenth of the driver's time", sideStarts,
                        cluster.withDriver(TENTH * cluster.perPart(), TENTH * cluster.perEvaluation())));
    }

    private List<Point> curve(Variant variant) {
        return Arrays.stream(EXECUTORS).mapToObj(executors -> new Point(variant, executors,
                LongStream.range(seed, seed + REPEATS)
                        .mapToObj(each -> ClusterSimulation.run(variant.cluster, variant.load, executors, times, each))
                        .toList())).toList();
    }

    private static String csv(List<List<Point>> curves) {
        StringBuilder rows = new StringBuilder("variant,evaluations,runs_at_once,generations,seconds_per_part_of_driver,seconds_per_evaluation_of_driver,"
                + "second_tries,executors,repeats,seconds,efficiency,efficiency_sd,lost,copies\n");
        curves.stream().flatMap(List::stream).forEach(point -> {
            Load load = point.variant.load;
            rows.append('"').append(point.variant.name).append("\",").append(load.evaluations()).append(',')
                    .append(load.runsAtOnce()).append(',').append(load.generations()).append(',')
                    .append(point.variant.cluster.perPart()).append(',').append(point.variant.cluster.perEvaluation()).append(',').append(point.variant.cluster.speculation())
                    .append(',').append(point.executors).append(',').append(REPEATS).append(',')
                    .append(mean(point.usages.stream().mapToDouble(Usage::seconds))).append(',')
                    .append(point.efficiency().mean()).append(',').append(point.efficiency().standardDeviation()).append(',')
                    .append(mean(point.usages.stream().mapToDouble(Usage::lost))).append(',')
                    .append(mean(point.usages.stream().mapToDouble(Usage::copies))).append('\n');
        });
        return rows.toString();
    }

    private static double mean(DoubleStream values) {
        return values.average().orElseThrow();
    }

    private static XYChart chart(List<List<Point>> curves) {
        XYChart chart = new XYChartBuilder().width(1100).height(560).title("How well a cluster is used")
                .xAxisTitle("executors").yAxisTitle("share of their time in evaluations that count").build();
        chart.getStyler().setXAxisLogarithmic(true).setYAxisMin(0.0).setYAxisMax(1.0).setXAxisMin(10.0).setXAxisMax(10_000.0)
                .setLegendPosition(Styler.LegendPosition.OutsideS).setChartBackgroundColor(Color.WHITE);
        for (List<Point> curve : curves) {
            chart.addSeries(curve.get(0).variant.name, Arrays.stream(EXECUTORS).mapToDouble(each -> each).toArray(),
                    curve.stream().mapToDouble(point -> point.efficiency().mean()).toArray());
        }
        return chart;
    }

    private String page(List<List<Point>> curves, String command) {
        double[] sorted = Arrays.stream(times).sorted().toArray();
        List<String> lines = new ArrayList<>();
        lines.add("""
                # How well a cluster would be used

                %s A simulation, not a measurement of a cluster. Made with

                ```
                %s
                ```

                Evaluations take what %d gaits drawn at random took, one after another (`times.csv`): median %.2f s, from %.2f to %.2f s.
                Assumed of the cluster: %s. Each number is the mean of %d repeats with seeds of their own, ± their standard deviation.

                *Efficiency* is the share of all executors' time that went into evaluations which counted, at the speed of an executor that
                is not slow. Lost and repeated work, slow machines, and waiting for the last evaluation of a generation lower it.

                ![efficiency against executors](efficiency.png)
                """.formatted(GeneratedPage.MARK, command, times.length, sorted[sorted.length / 2], sorted[0], sorted[sorted.length - 1],
                described(), REPEATS));
        StringBuilder table = new StringBuilder("| load | below 0.8 from | ");
        Arrays.stream(EXECUTORS).forEach(each -> table.append(each).append(" | "));
        table.append("\n| --- | ---: |").append(" ---: |".repeat(EXECUTORS.length)).append('\n');
        for (List<Point> curve : curves) {
            table.append("| ").append(curve.get(0).variant.name).append(" | ").append(limit(curve)).append(" |");
            curve.forEach(point -> table.append(' ').append(Numbers.withError(point.efficiency().mean(),
                    point.efficiency().standardDeviation(), 2)).append(" |"));
            table.append('\n');
        }
        lines.add(table.toString());
        return String.join("\n", lines);
    }

    private String described() {
        return format("the driver spends %.1f ms on each part of a generation, %.1f ms on each evaluation and %.2f s between generations, one after "
                + "another; a part is half of what is left for each executor, and takes at most %.0f s; %.0f ms from the driver "
                + "to an executor and back; an executor fails %.2f times an hour and is back after %.0f s; %.0f %% of the executors are %.1f "
                + "times as slow; %s", 1e3 * cluster.perPart(), 1e3 * cluster.perEvaluation(), cluster.perGeneration(), PartSize.LONGEST,
                1e3 * cluster.latency(),
                cluster.failuresPerHour(), cluster.restart(), 100 * cluster.slowShare(), cluster.slowFactor(),
                cluster.speculation() ? "what is slow is begun a second time" : "nothing is begun a second time");
    }

    /** Executors from which on the efficiency is below what is enough, between two that were simulated. */
    private static String limit(List<Point> curve) {
        OptionalDouble found = OptionalDouble.empty();
        for (int i = 0; i < curve.size() && found.isEmpty(); i++) {
            double here = curve.get(i).efficiency().mean();
            if (here < ENOUGH) {
                found = OptionalDouble.of(i == 0 ? 0 : between(curve.get(i - 1), curve.get(i)));
            }
        }
        return found.isEmpty() ? "more than " + EXECUTORS[EXECUTORS.length - 1]
                : found.getAsDouble() == 0 ? "fewer than " + EXECUTORS[0] : "" + twoDigits(found.getAsDouble());
    }

    private static long twoDigits(double value) {
        double unit = Math.pow(10, Math.floor(Math.log10(value)) - 1);
        return Math.round(Math.round(value / unit) * unit);
    }

    private static double between(Point above, Point below) {
        double share = (above.efficiency().mean() - ENOUGH) / (above.efficiency().mean() - below.efficiency().mean());
        return above.executors * Math.pow((double) below.executors / above.executors, share);
    }

    private static String format(String pattern, Object... values) {
        return String.format(Locale.ROOT, pattern, values);
    }
}
