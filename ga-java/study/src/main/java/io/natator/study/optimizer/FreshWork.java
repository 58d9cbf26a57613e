package io.natator.study.optimizer;

import io.natator.checkpoint.StoredRun;
import io.natator.evolution.Individual;
import io.natator.run.FreshStarts;
import io.natator.run.Lanes;
import io.natator.simulator.Evaluator;
import io.natator.simulator.SimulationResult;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;
import java.util.stream.Collectors;

/**
 * Gaits of one finished run that are to be run from fresh starts.
 *
 * @param run        with its summary
 * @param genomes    those that led it when runs are compared
 * @param rankStarts fresh starts of all gaits of the last generation; 0 if these are not to be ranked
 * @param results    where it is noted
 */
record FreshWork(OptimizerRun run, List<List<Double>> genomes, int rankStarts, FreshResults results) {

    /** What is missing of a run whose course is compared with that of these. */
    static FreshWork of(OptimizerRun run, List<RunSummary> all, int rankStarts, FreshResults results) {
        List<List<Double>> genomes = EqualBudget.leaders(run.summary(), all, EqualBudget.SHARES).stream()
                .filter(genes -> Double.isNaN(results.worth(run, genes))).toList();
        return new FreshWork(run, genomes, isRanked(run, rankStarts, results) ? 0 : rankStarts, results);
    }

    /** Whether there is nothing left to rank of a run. */
    static boolean isRanked(OptimizerRun run, int rankStarts, FreshResults results) {
        RankedGeneration known = results.rank(run);
        return rankStarts == 0 || known != null && known.starts() == rankStarts;
    }

    boolean isDone() {
        return genomes.isEmpty() && rankStarts == 0;
    }

    /** The same as something to be carried out. */
    Lanes.Work with(Evaluator evaluator, Path simulator) {
        return () -> {
            FreshStarts starts = new FreshStarts(run.settings(), evaluator, simulator);
            List<List<SimulationResult>> again = starts.each(genomes, FreshStarts.usual(run.settings()));
            for (int i = 0; i < genomes.size(); i++) {
                results.add(new FreshGait(run.variant().label(), run.settings().seed(), genomes.get(i), scores(again.get(i))));
            }
            if (rankStarts > 0) {
                rank(starts);
            }
        };
    }

    private void rank(FreshStarts starts) throws InterruptedException {
        Map<List<Double>, Individual> last = StoredRun.state(run.directory()).population().stream()
                .collect(Collectors.toMap(Individual::genes, Function.identity(), (one, same) -> one,
                        LinkedHashMap::new));
        List<Double> again = starts.each(List.copyOf(last.keySet()), rankStarts).stream()
                .map(results -> run.settings().judge().of(scores(results))).toList();
        results.add(RankedGeneration.of(run, rankStarts, List.copyOf(last.values()), again));
    }

    private static List<Double> scores(List<SimulationResult> results) {
        return results.stream().map(SimulationResult::score).toList();
    }
}
