package io.natator.checkpoint;

import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.config.Aggregate;
import java.util.List;
import java.util.Objects;

/**
 * A winner as a reader gets it again: by runs from starts that had no part in choosing it.
 *
 * @param duration      of a run that nothing ends early, in seconds
 * @param base          as the run simulates
 * @param halfStep      the same starts at half the time step; null if that was not tried
 * @param judge         what several runs are worth in this run
 * @param selected      what the winner was worth when it was chosen
 * @param selectedRuns  by so many runs
 * @param again         what it is worth by the fresh runs of {@code base}
 * @param selectionLoss share of the selected worth that it does not have again; null where it had none, or no more than the standard error of the
 *                      fresh runs
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record FreshRuns(double duration, SwimSample base, SwimSample halfStep, Aggregate judge, double selected,
        int selectedRuns, double again, Double selectionLoss) {

    /** Requires the runs and the judge. */
    public FreshRuns {
        Objects.requireNonNull(base, "base");
        Objects.requireNonNull(judge, "judge");
    }

    /**
     * With the loss that follows.
     *
     * @param worths what each of the fresh runs is worth
     */
    public static FreshRuns of(double duration, SwimSample base, SwimSample halfStep, Aggregate judge, double selected,
            int selectedRuns, List<Double> worths) {
        return new FreshRuns(duration, base, halfStep, judge, selected, selectedRuns, judge.of(worths),
                loss(judge, selected, worths));
    }

    /**
     * The selection loss.
     *
     * @param worths what each of the fresh runs is worth
     */
    public static Double loss(Aggregate judge, double selected, List<Double> worths) {
        double error = Spread.of(worths).standardError(worths.size());
        return selected > error ? 1 - judge.of(worths) / selected : null;
    }
}
