package io.natator.study.optimizer;

import java.util.Arrays;
import java.util.List;

/**
 * Best fitness of several runs of one optimizer against the number of evaluations.
 *
 * @param label  of the optimizer
 * @param curves best fitness after each evaluation, one array per run, all of the same length
 */
record CurveBand(String label, List<double[]> curves) {

    /** Evaluations of each run. */
    int evaluations() {
        return curves.get(0).length;
    }

    /**
     * A quantile over the runs, with linear interpolation between the nearest (type 7 of Hyndman and Fan 1996).
     *
     * @param evaluations 1 to {@link #evaluations()}
     * @param share       0 for the worst run, 0.5 for the median, 1 for the best
     */
    double quantile(int evaluations, double share) {
        double[] values = values(evaluations);
        Arrays.sort(values);
        double place = share * (values.length - 1);
        int below = (int) Math.floor(place);
        int above = Math.min(below + 1, values.length - 1);
        return values[below] + (place - below) * (values[above] - values[below]);
    }

    double mean(int evaluations) {
        return Arrays.stream(values(evaluations)).average().orElseThrow();
    }

    /** Of the sample; NaN for a single run. */
    double standardDeviation(int evaluations) {
        double[] values = values(evaluations);
        double mean = mean(evaluations);
        double squares = Arrays.stream(values).map(value -> (value - mean) * (value - mean)).sum();
        return Math.sqrt(squares / (values.length - 1));
    }

    private double[] values(int evaluations) {
        return curves.stream().mapToDouble(curve -> curve[evaluations - 1]).toArray();
    }
}
