package io.natator.evolution;

import io.natator.config.Judge;
import java.util.ArrayList;
import java.util.List;

/**
 * What a gait is worth, by runs from several starts.
 *
 * @param score the worth
 * @param runs  what each run was worth, in the order in which they were made
 */
public record Estimate(double score, List<Double> runs) {

    /** Copies the list. */
    public Estimate {
        runs = List.copyOf(runs);
    }

    /** By these runs, at least one. */
    static Estimate of(List<Double> runs, Judge judge) {
        return new Estimate(judge.of(runs), runs);
    }

    /** With more runs. */
    Estimate with(List<Double> more, Judge judge) {
        List<Double> all = new ArrayList<>(runs);
        all.addAll(more);
        return of(all, judge);
    }
}
