package io.natator.evolution;

import io.natator.config.Aggregate;
import java.util.List;

/**
 * Picks the candidate with the highest mean minus one standard error, to limit selection bias: the greatest of many means of few
 * runs is mostly luck.
 */
public final class LowerConfidenceBound {

    private LowerConfidenceBound() {
    }

    /**
     * The place of the pick in a list of candidates.
     *
     * @param best estimates of the candidates
     * @return from 0; -1 without candidates
     */
    public static int of(List<Estimate> best) {
        double deviation = deviation(best);
        int pick = -1;
        for (int i = 0; i < best.size(); i++) {
            if (pick < 0 || bound(best.get(i), deviation) > bound(best.get(pick), deviation)) {
                pick = i;
            }
        }
        return pick;
    }

    private static double bound(Estimate one, double deviation) {
        return one.score() - deviation / Math.sqrt(one.runs().size());
    }

    /** Standard deviation of the runs of one gait, pooled over all these gaits. */
    private static double deviation(List<Estimate> estimates) {
        double squares = 0;
        int freedom = 0;
        for (Estimate one : estimates) {
            double mean = Aggregate.MEAN.of(one.runs());
            squares += one.runs().stream().mapToDouble(run -> (run - mean) * (run - mean)).sum();
            freedom += one.runs().size() - 1;
        }
        return freedom == 0 ? 0 : Math.sqrt(squares / freedom);
    }
}
