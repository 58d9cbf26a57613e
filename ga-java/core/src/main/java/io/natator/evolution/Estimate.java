package io.natator.evolution;

import com.fasterxml.jackson.annotation.JsonIgnore;
import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.config.Aggregate;
import io.natator.protocol.Effort;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

/**
 * What a gait is worth, by runs from several starts.
 *
 * @param score      the worth; of a gait that was unstable in any run that of its worst run, and never more than 0
 * @param runs       what each run was worth, in the order in which they were made
 * @param objectives means by each of the run's objectives; null where it has none
 * @param effort     what the runs that were measured took together; null where nobody asked
 * @param unstable   how many runs broke a law of mechanics; null if none did
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record Estimate(double score, List<Double> runs, List<Double> objectives, Effort effort, Integer unstable) {

    /** Copies the lists. */
    public Estimate {
        runs = List.copyOf(runs);
        objectives = objectives == null ? null : List.copyOf(objectives);
    }

    /** An estimate without objectives or effort. */
    public Estimate(double score, List<Double> runs) {
        this(score, runs, null, null, null);
    }

    /** The estimate that at least one run gives. */
    static Estimate of(List<SimulationResult> results, Aggregate judge) {
        return new Estimate(0, List.of()).with(results, judge);
    }

    /** With more runs. */
    Estimate with(List<SimulationResult> more, Aggregate judge) {
        List<Double> all = new ArrayList<>(runs);
        more.forEach(one -> all.add(one.score()));
        int broken = (int) more.stream().filter(one -> one.status() == SimulationResult.Status.UNSTABLE).count()
                + (unstable == null ? 0 : unstable);
        return new Estimate(broken == 0 ? judge.of(all) : Math.min(Collections.min(all), 0), all, means(more),
                sum(more), broken == 0 ? null : broken);
    }

    /** This estimate for a gait that was also unstable in a run that is not among these. */
    Estimate refused() {
        return isStable() ? new Estimate(Math.min(Collections.min(runs), 0), runs, objectives, effort, 1) : this;
    }

    /** Whether every run kept to the laws of mechanics; what does not is worth nothing by its other runs. */
    @JsonIgnore
    public boolean isStable() {
        return unstable == null;
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
