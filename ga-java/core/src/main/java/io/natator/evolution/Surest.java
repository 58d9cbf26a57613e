package io.natator.evolution;

import io.natator.config.Judge;
import java.util.List;

/**
 * Whom of the best to take: the one that is worth most less a standard error, since the greatest of many means of few runs is
 * mostly luck.
 */
public final class Surest {

    private Surest() {
    }

    /**
     * Of the best gaits of a run.
     *
     * @return its place among them; -1 of none
     */
    public static int of(List<Estimate> best) {
        double deviation = deviation(best);
        int surest = -1;
        for (int i = 0; i < best.size(); i++) {
            if (surest < 0 || sure(best.get(i), deviation) > sure(best.get(surest), deviation)) {
                surest = i;
            }
        }
        return surest;
    }

    private static double sure(Estimate one, double deviation) {
        return one.score() - deviation / Math.sqrt(one.runs().size());
    }

    /** How far the runs of a gait scatter, by all runs of all these together. */
    private static double deviation(List<Estimate> estimates) {
        double squares = 0;
        int freedom = 0;
        for (Estimate one : estimates) {
            double mean = Judge.MEAN.of(one.runs());
            squares += one.runs().stream().mapToDouble(run -> (run - mean) * (run - mean)).sum();
            freedom += one.runs().size() - 1;
        }
        return freedom == 0 ? 0 : Math.sqrt(squares / freedom);
    }
}
