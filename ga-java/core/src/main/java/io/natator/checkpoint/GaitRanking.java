package io.natator.checkpoint;

import io.natator.body.Genome;
import io.natator.body.Swimmer;
import io.natator.config.EvolutionSettings;
import io.natator.evolution.Estimate;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.LowerConfidenceBound;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.NavigableSet;
import java.util.TreeSet;

/** The gaits of a run as its evaluations become known one after another. */
public final class GaitRanking {

    private final EvolutionSettings settings;
    private final Genome genome;
    private final Map<List<Double>, Runs> gaits = new HashMap<>();
    /** Those that count, the best first, the earlier of equals. */
    private final NavigableSet<Runs> ranked = new TreeSet<>(
            Comparator.comparingDouble((Runs one) -> one.estimate.score()).reversed()
                    .thenComparingInt(one -> one.number));
    private int numbers;

    /** A gait's runs. */
    private final class Runs {
        private final EvaluationRecord first;
        private final int number = numbers++;
        private Estimate estimate = new Estimate(0, List.of());
        private boolean measured;
        private boolean unstable;
        /** Made when it is asked for. */
        private Swimmer swimmer;

        Runs(EvaluationRecord first) {
            this.first = first;
        }

        void add(SimulationResult result) {
            List<Double> runs = new ArrayList<>(estimate.runs());
            runs.add(result.score());
            estimate = new Estimate(settings.search().judge().of(runs), runs);
            measured |= result.status() == SimulationResult.Status.OK;
            unstable |= result.status() == SimulationResult.Status.UNSTABLE;
        }

        /** Whether it has all the runs of a newborn, swam in one, and was unstable in none. */
        boolean counts() {
            return measured && !unstable && estimate.runs().size() >= settings.search().starts();
        }

        GaitScore toScore() {
            swimmer = swimmer == null ? new Swimmer(first.gait(), genome.body(first.genes())) : swimmer;
            return new GaitScore(first.genes(), swimmer, first.generation(), estimate.score(), estimate.runs().size());
        }
    }

    /** Those of these evaluations alone, the best first. */
    public static List<GaitScore> ranked(EvolutionSettings settings, List<EvaluationRecord> evaluations) {
        GaitRanking gaits = new GaitRanking(settings);
        evaluations.forEach(gaits::add);
        return gaits.ranked();
    }

    GaitRanking(EvolutionSettings settings) {
        this.settings = settings;
        this.genome = settings.problem().genome();
    }

    void add(EvaluationRecord evaluation) {
        Runs known = gaits.get(evaluation.genes());
        if (settings.search().starts() == 1 && known != null && known.counts()) {
            return; // The same run again tells nothing new.
        }
        Runs runs = settings.search().starts() == 1 || known == null ? new Runs(evaluation) : known;
        gaits.put(evaluation.genes(), runs);
        ranked.remove(runs);
        runs.add(evaluation.result());
        if (runs.counts()) {
            ranked.add(runs);
        }
    }

    /** The gait that the run would take for its winner, had it ended here; null without any. */
    GaitScore best() {
        List<Runs> best = ranked.stream()
                .limit(settings.search().starts() == 1 ? 1 : Math.max(settings.search().elites(), 1)).toList();
        return best.isEmpty() ? null
                : best.get(LowerConfidenceBound.of(best.stream().map(one -> one.estimate).toList())).toScore();
    }

    /** All that swam, the best first. */
    List<GaitScore> ranked() {
        return ranked.stream().map(Runs::toScore).toList();
    }
}
