package io.natator.compare;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.Numbers;
import io.natator.checkpoint.RunReader;
import io.natator.checkpoint.Spread;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.evolution.Individual;
import io.natator.process.Evaluator;
import io.natator.protocol.SimulationResult;
import io.natator.run.FreshStarts;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;

/**
 * Some runs side by side by what their best gaits do from fresh starts, after equal numbers of evaluations and after equal
 * simulated time: by what all of them were evolved for, or by distance where that differs. Runs that differ in nothing but
 * their seeds stand together where all have such company: then each run counts as one value, its mean; else each start of a
 * run does.
 */
public final class RunComparison {

    private final List<RunSummary> runs;
    private final int starts;
    private final List<Double> shares;
    private final List<Map<List<Double>, List<SimulationResult>>> swims = new ArrayList<>();

    /**
     * Runs that may still be under way.
     *
     * @param folders of the runs, at least two
     * @param starts  fresh starts of each gait
     * @param early   whether the best gaits at a tenth, a quarter and half of the budgets are run too
     */
    public RunComparison(List<Path> folders, int starts, boolean early) {
        this.runs = folders.stream().map(RunSummary::of).toList();
        this.starts = starts;
        this.shares = early ? EqualBudget.SHARES : List.of(1.0);
    }

    /** How many swims that takes. */
    public int swims() {
        return starts * runs.stream().mapToInt(run -> genomes(run).size()).sum();
    }

    /** Runs the gaits. */
    public void run(Evaluator evaluator, Path simulator) throws InterruptedException {
        for (RunSummary run : runs) {
            List<List<Double>> genomes = genomes(run);
            List<List<SimulationResult>> again = new FreshStarts(run.settings(), evaluator, simulator).each(genomes,
                    starts);
            Map<List<Double>, List<SimulationResult>> own = new HashMap<>();
            for (int i = 0; i < genomes.size(); i++) {
                own.put(genomes.get(i), List.copyOf(again.get(i)));
            }
            swims.add(own);
        }
    }

    private List<List<Double>> genomes(RunSummary run) {
        return EqualBudget.leaders(run, runs, shares);
    }

    /**
     * The runs as lines of JSON, once the gaits were run: what they are compared by, and in {@code again} what each gait's swims
     * were worth.
     *
     * @param rankStarts fresh starts from which all gaits of each last generation are run too, for {@code last}; 0 for none
     */
    public List<String> json(int rankStarts, Evaluator evaluator, Path simulator) throws InterruptedException {
        List<String> lines = new ArrayList<>();
        for (int i = 0; i < runs.size(); i++) {
            RunSummary run = runs.get(i);
            ObjectNode line = (ObjectNode) Json.tree(run);
            ArrayNode again = line.putArray("again");
            swims.get(i).forEach(
                    (genes, results) -> again.addObject().putPOJO("genes", genes).putPOJO("runs", scores(results)));
            if (rankStarts > 0) {
                List<Individual> last = RunReader.state(Path.of(run.run())).population().stream()
                        .collect(
                                Collectors.toMap(Individual::genes, one -> one, (one, same) -> one, LinkedHashMap::new))
                        .values().stream().toList();
                List<List<SimulationResult>> found = new FreshStarts(run.settings(), evaluator, simulator)
                        .each(last.stream().map(Individual::genes).toList(), rankStarts);
                ArrayNode ranked = line.putArray("last");
                for (int k = 0; k < last.size(); k++) {
                    ranked.addObject().put("selected", last.get(k).score()).putPOJO("runs", scores(found.get(k)));
                }
            }
            lines.add(Json.line(line));
        }
        return lines;
    }

    private static List<Double> scores(List<SimulationResult> results) {
        return results.stream().map(SimulationResult::score).toList();
    }

    /** Tables as text, once the gaits were run. */
    public List<String> lines() {
        List<String> lines = new ArrayList<>();
        List<List<Integer>> groups = groups();
        boolean byRun = groups.get(0).size() > 1;
        Metric metric = Metric.of(runs.stream().map(RunSummary::settings).toList(), swims);
        for (EqualBudget budget : EqualBudget.values()) {
            double place = budget.at(1, runs);
            if (Double.isNaN(place)) {
                lines.add("at equal " + budget.label() + ": not recorded by these runs");
                continue;
            }
            lines.add("at equal " + budget.label() + " (" + budget.text(place) + "), from " + starts
                    + " fresh starts: median " + metric.name() + (byRun ? " of the runs' means" : "")
                    + " [95 % bootstrap interval]");
            Map<String, double[]> samples = new LinkedHashMap<>();
            groups.forEach(group -> samples.put(name(group), sample(group, byRun, metric, budget, place)));
            int decimals = Numbers.worthDecimals(
                    samples.values().stream().flatMapToDouble(Arrays::stream).map(Math::abs).max().orElse(0));
            samples.forEach((name, sample) -> lines.add("   " + name + "  "
                    + (sample.length == 0 ? "no gait" : MedianInterval.of(sample).text(1, decimals))));
            PairTest.all(samples).forEach(pair -> lines.add("   " + pair.first() + " less " + pair.second() + "  "
                    + pair.difference().text(1, decimals) + ": " + pair.verdict(metric.greater())));
        }
        return lines;
    }

    /** Numbers of the runs that are taken together, in their order. */
    private List<List<Integer>> groups() {
        Map<EvolutionSettings, List<Integer>> bySettings = new LinkedHashMap<>();
        for (int i = 0; i < runs.size(); i++) {
            bySettings.computeIfAbsent(runs.get(i).settings().withSeed(0), settings -> new ArrayList<>()).add(i);
        }
        boolean company = bySettings.size() > 1 && bySettings.values().stream().allMatch(group -> group.size() > 1);
        List<List<Integer>> alone = new ArrayList<>();
        for (int i = 0; i < runs.size(); i++) {
            alone.add(List.of(i));
        }
        return company ? List.copyOf(bySettings.values()) : alone;
    }

    private static String name(List<Integer> group) {
        return (group.size() > 1 ? "runs " : "run ")
                + group.stream().map(i -> Integer.toString(i + 1)).collect(Collectors.joining("+"));
    }

    private double[] sample(List<Integer> group, boolean byRun, Metric metric, EqualBudget budget, double place) {
        List<Double> sample = new ArrayList<>();
        for (int i : group) {
            List<Double> leader = runs.get(i).leader(budget, place);
            if (leader != null) {
                List<Double> own = swims.get(i).get(leader).stream().map(metric.value()).toList();
                sample.addAll(byRun ? List.of(Spread.of(own).mean()) : own);
            }
        }
        return sample.stream().mapToDouble(Double::doubleValue).toArray();
    }
}
