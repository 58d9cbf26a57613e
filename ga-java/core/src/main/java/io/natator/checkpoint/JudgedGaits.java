package io.natator.checkpoint;

import io.natator.config.EvolutionSettings;
import io.natator.evolution.EvaluationRecord;
import io.natator.simulator.SimulationResult;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** The gaits of a run as its evaluations become known one after another. */
final class JudgedGaits {

    private final EvolutionSettings settings;
    private final Map<List<Double>, Runs> gaits = new LinkedHashMap<>();
    private Runs best;

    /** A gait's runs. */
    private final class Runs {
        private final EvaluationRecord first;
        private final List<Double> scores = new ArrayList<>();
        private boolean measured;

        Runs(EvaluationRecord first) {
            this.first = first;
        }

        double score() {
            return settings.judge().of(scores);
        }

        /** Whether it has all the runs of a newborn, and swam in one. */
        boolean counts() {
            return measured && scores.size() >= settings.starts();
        }

        JudgedGait judged() {
            return new JudgedGait(first.gait(), first.generation(), score(), scores.size());
        }
    }

    JudgedGaits(EvolutionSettings settings) {
        this.settings = settings;
    }

    void add(EvaluationRecord evaluation) {
        // With one start each evaluation is a gait of its own, also where the same genes came up twice.
        Runs runs = settings.starts() == 1 ? new Runs(evaluation)
                : gaits.computeIfAbsent(evaluation.genes(), genes -> new Runs(evaluation));
        runs.scores.add(evaluation.result().score());
        runs.measured |= evaluation.result().status() == SimulationResult.Status.OK;
        if (settings.starts() == 1) {
            gaits.putIfAbsent(evaluation.genes(), runs);
        }
        if (runs == best) {
            best = null;
            gaits.values().forEach(this::offer);
        } else {
            offer(runs);
        }
    }

    private void offer(Runs one) {
        if (one.counts() && (best == null || one.score() > best.score())) {
            best = one;
        }
    }

    /** The best so far, the earliest of equals; null without any. */
    JudgedGait best() {
        return best == null ? null : best.judged();
    }

    /** All that swam, the best first. */
    List<JudgedGait> ranked() {
        return gaits.values().stream().filter(Runs::counts).map(Runs::judged)
                .sorted(Comparator.comparingDouble(JudgedGait::score).reversed()).toList();
    }
}
