package io.natator.evolution;

import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.config.Judge;
import io.natator.simulator.Effort;
import io.natator.simulator.SimulationResult;
import java.util.ArrayList;
import java.util.List;

/**
 * What a gait is worth, by runs from several starts.
 *
 * @param score      the worth
 * @param runs       what each run was worth, in the order in which they were made
 * @param objectives means by each of the run's objectives; null where it has none
 * @param effort     what the runs that were measured took together; null where nobody asked
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record Estimate(double score, List<Double> runs, List<Double> objectives, Effort effort) {

    /** Copies the lists. */
    public Estimate {
        runs = List.copyOf(runs);
        objectives = objectives == null ? null : List.copyOf(objectives);
    }

    /** By what the runs were worth alone. */
    public Estimate(double score, List<Double> runs) {
        this(score, runs, null, null);
    }

    /** By these runs, at least one. */
    static Estimate of(List<SimulationResult> results, Judge judge) {
        return new Estimate(0, List.of()).with(results, judge);
    }

    /** With more runs. */
    Estimate with(List<SimulationResult> more, Judge judge) {
        List<Double> all = new ArrayList<>(runs);
        more.forEach(one -> all.add(one.score()));
        return new Estimate(judge.of(all), all, means(more), sum(more));
    }

    private Effort sum(List<SimulationResult> more) {
        Effort sum = effort;
        for (SimulationResult one : more) {
            if (one.effort() != null) {
                sum = sum == null ? one.effort() : sum.plus(one.effort());
            }
        }
        return sum;
    }

    private List<Double> means(List<SimulationResult> more) {
        if (more.isEmpty() || more.get(0).objectives() == null) {
            return objectives;
        }
        List<Double> means = new ArrayList<>();
        for (int i = 0; i < more.get(0).objectives().size(); i++) {
            double sum = objectives == null ? 0 : objectives.get(i) * runs.size();
            for (SimulationResult one : more) {
                sum += one.objectives().get(i);
            }
            means.add(sum / (runs.size() + more.size()));
        }
        return means;
    }
}
