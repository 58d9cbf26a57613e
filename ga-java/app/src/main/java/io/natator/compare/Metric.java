package io.natator.compare;

import io.natator.config.EvolutionSettings;
import io.natator.config.FitnessKind;
import io.natator.config.WeightedObjective;
import io.natator.protocol.SimulationResult;
import java.util.Collection;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.function.Function;

/**
 * A quantity by which runs are compared.
 *
 * @param name    its name in reports, such as "distance"
 * @param greater comparative used in reports, such as "further than"
 * @param value   its value of a swim
 */
record Metric(String name, String greater, Function<SimulationResult, Double> value) {

    private static final Function<SimulationResult, Double> SCORE = SimulationResult::score;
    private static final Metric DISTANCE = new Metric("distance", "further than", SimulationResult::distanceOrZero);

    /**
     * What all runs were evolved for, or distance where that differs.
     *
     * @param runs  their settings
     * @param swims of each, by genes
     */
    static Metric of(List<EvolutionSettings> runs, List<Map<List<Double>, List<SimulationResult>>> swims) {
        Set<Metric> all = new HashSet<>();
        for (int i = 0; i < runs.size(); i++) {
            all.add(of(runs.get(i), swims.get(i).values()));
        }
        return all.size() == 1 ? all.iterator().next() : DISTANCE;
    }

    private static Metric of(EvolutionSettings run, Collection<List<SimulationResult>> swims) {
        if (run.problem().objectives() != null) {
            return worth("worth by " + WeightedObjective.text(WeightedObjective.leading(run.problem().objectives())));
        }
        if (swims.stream().flatMap(List::stream).anyMatch(swim -> swim.goals() != null)) {
            return worth("score by the goals of " + run.problem().scene());
        }
        return run.problem().fitness() == FitnessKind.NET ? worth("distance less the drift in vacuum") : DISTANCE;
    }

    private static Metric worth(String name) {
        return new Metric(name, "better than", SCORE);
    }
}
