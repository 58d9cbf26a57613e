package io.natator.study.optimizer;

import io.natator.config.Numbers;
import io.natator.run.FreshStarts;
import io.natator.study.statistics.MedianInterval;
import io.natator.study.statistics.PairTest;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Objects;
import java.util.function.ToDoubleFunction;
import java.util.stream.Collectors;
import java.util.stream.DoubleStream;
import java.util.stream.Stream;

/** What the best gaits of the runs on one scene do from fresh starts, optimizers side by side. */
final class FreshTables {

    /** Columns of {@link #medianLines}. */
    static final String MEDIANS = "scene,equal,place,optimizer,runs,median,low,high\n";
    /** Columns of {@link #testLines}. */
    static final String TESTS = "scene,equal,place,first,second,difference,low,high,p,p_holm,a,cliffs_delta,verdict\n";

    private final String scene;
    private final Map<OptimizerVariant, List<OptimizerRun>> byVariant = new LinkedHashMap<>();
    private final List<OptimizerRun> runs;
    private final FreshResults results;

    /**
     * Of finished runs, at least one.
     *
     * @param runs with their summaries
     */
    FreshTables(String scene, List<OptimizerRun> runs, FreshResults results) {
        this.scene = scene;
        this.runs = runs;
        this.results = results;
        for (OptimizerVariant variant : OptimizerVariant.values()) {
            List<OptimizerRun> own = runs.stream().filter(run -> run.variant() == variant).toList();
            if (!own.isEmpty()) {
                byVariant.put(variant, own);
            }
        }
    }

    /** As text of the page. */
    String page() {
        StringBuilder page = new StringBuilder("\n### Again\n\nThe best gaits so far from "
                + FreshStarts.usual(runs.get(0).settings())
                + " fresh starts each: median over the runs [95 % bootstrap interval] of what they are worth then.\n");
        for (EqualBudget budget : EqualBudget.values()) {
            page.append("\nAt equal ").append(budget.label()).append(":\n\n").append(medians(budget));
        }
        page.append("\n### Differences\n\nFrom fresh starts, at the end. *A* is the chance that a run of the first comes "
                + "further than one of the second; p is corrected for all pairs of the table.\n");
        for (EqualBudget budget : EqualBudget.values()) {
            page.append("\nAt equal ").append(budget.label()).append(":\n\n").append(tests(budget));
        }
        return page.append("\n### The choice\n\nMedian over the runs [95 % bootstrap interval]: the share of what winners were chosen "
                + "for that they lack from fresh starts, where they were chosen for more than those are uncertain by; and the rank correlation (Spearman) of the last generation's gaits as "
                + "the run ranked them with their order by fresh starts.\n\n").append(choice()).toString();
    }

    private double place(EqualBudget budget, double share) {
        return budget.at(share, runs.stream().map(OptimizerRun::summary).toList());
    }

    /** What each run's best gait at a place is worth from fresh starts, as far as it is known. */
    private double[] worths(List<OptimizerRun> own, EqualBudget budget, double place) {
        return own.stream().mapToDouble(run -> {
            List<Double> genes = run.summary().leader(budget, place);
            return genes == null ? Double.NaN : results.worth(run, genes);
        }).filter(Double::isFinite).toArray();
    }

    private String medians(EqualBudget budget) {
        if (Double.isNaN(place(budget, 1))) {
            return "not recorded by these runs\n";
        }
        StringBuilder table = new StringBuilder("| optimizer | runs |");
        EqualBudget.SHARES.forEach(share -> table.append(" after ").append(budget.text(place(budget, share))).append(" |"));
        table.append("\n| --- | ---: |").append(" ---: |".repeat(EqualBudget.SHARES.size())).append('\n');
        byVariant.forEach((variant, own) -> {
            table.append("| ").append(variant.label()).append(" | ")
                    .append(worths(own, budget, place(budget, 1)).length).append(" |");
            EqualBudget.SHARES.forEach(share -> table.append(' ').append(interval(worths(own, budget, place(budget, share)), 1, 4))
                    .append(" |"));
            table.append('\n');
        });
        return table.toString();
    }

    private List<PairTest> pairs(EqualBudget budget) {
        Map<String, double[]> samples = new LinkedHashMap<>();
        byVariant.forEach((variant, own) -> samples.put(variant.label(), worths(own, budget, place(budget, 1))));
        return PairTest.all(samples);
    }

    private String tests(EqualBudget budget) {
        List<PairTest> pairs = pairs(budget);
        if (pairs.isEmpty()) {
            return "nothing to compare\n";
        }
        return pairs.stream().map(pair -> "| " + pair.first() + " | " + pair.second() + " | "
                + pair.difference().text(1, 4) + " | " + PairTest.chance(pair.p()).replaceFirst("^= ", "") + " | "
                + Numbers.fixed(pair.test().a(), 2) + " | " + Numbers.fixed(pair.test().cliffsDelta(), 2) + " | "
                + pair.verdict() + " |\n")
                .collect(Collectors.joining("", "| first | second | difference of medians | p | A | Cliff's δ | verdict |\n"
                        + "| --- | --- | ---: | ---: | ---: | ---: | --- |\n", ""));
    }

    private String choice() {
        StringBuilder table = new StringBuilder("| optimizer | runs | selection loss | runs | rank correlation |\n"
                + "| --- | ---: | ---: | ---: | ---: |\n");
        byVariant.forEach((variant, own) -> table.append(choice(variant.label(), own)));
        return table.append(choice("all", runs)).toString();
    }

    private String choice(String label, List<OptimizerRun> own) {
        double[] losses = known(own, run -> orNaN(results.loss(run)));
        double[] ranks = known(own, run -> {
            RankedGeneration rank = results.rank(run);
            return rank == null ? Double.NaN : orNaN(rank.spearman());
        });
        return "| " + label + " | " + losses.length + " | " + interval(losses, 100, 1) + (losses.length == 0 ? "" : " %") + " | "
                + ranks.length + " | " + interval(ranks, 1, 2) + " |\n";
    }

    private static double orNaN(Double figure) {
        return figure == null ? Double.NaN : figure;
    }

    private static double[] known(List<OptimizerRun> own, ToDoubleFunction<OptimizerRun> figure) {
        return own.stream().mapToDouble(figure).filter(Double::isFinite).toArray();
    }

    private static String interval(double[] values, double factor, int digits) {
        return values.length == 0 ? "–" : MedianInterval.of(values).text(factor, digits);
    }

    /** The medians with all their digits. */
    String medianLines() {
        StringBuilder lines = new StringBuilder();
        for (EqualBudget budget : EqualBudget.values()) {
            for (double share : EqualBudget.SHARES) {
                double place = place(budget, share);
                byVariant.forEach((variant, own) -> {
                    double[] values = worths(own, budget, place);
                    if (values.length > 0) {
                        MedianInterval one = MedianInterval.of(values);
                        lines.append(line(Stream.of(scene, budget.label(), place, variant.label(), values.length),
                                one.median(), one.low(), one.high())).append('\n');
                    }
                });
            }
        }
        return lines.toString();
    }

    /** The tests with all their digits. */
    String testLines() {
        StringBuilder lines = new StringBuilder();
        for (EqualBudget budget : EqualBudget.values()) {
            for (PairTest pair : pairs(budget)) {
                lines.append(line(Stream.of(scene, budget.label(), place(budget, 1), pair.first(), pair.second()),
                        pair.difference().median(), pair.difference().low(), pair.difference().high(), pair.test().p(),
                        pair.p(), pair.test().a(), pair.test().cliffsDelta())).append(",\"").append(pair.verdict()).append("\"\n");
            }
        }
        return lines.toString();
    }

    private static String line(Stream<?> names, double... figures) {
        return Stream.concat(names.map(Objects::toString), DoubleStream.of(figures)
                .mapToObj(one -> Double.isFinite(one) ? String.format(Locale.ROOT, "%s", one) : ""))
                .collect(Collectors.joining(","));
    }
}
