package io.natator.config;

import io.soabase.recordbuilder.core.RecordBuilder;

/**
 * How gaits are searched for, and how each is judged.
 *
 * @param optimizer         what searches
 * @param population        chromosomes at the start and selected in each generation (thesis: 150); for the other
 *                          optimizers the evaluations of a generation; from 2 to {@link Limits#POPULATION}
 * @param seed              of all random choices
 * @param operators         which genetic operators to use
 * @param gaussianDeviation deviation of the Gaussian mutation as a share of the gene's range, above 0; JGAP's own: 0.05
 * @param starts            runs of each new gait, each from a start of its own, from 1 to {@link Limits#STARTS}; 1 is one
 *                          run from the scene's own start, as in the thesis
 * @param judge             what several runs are worth
 */
@RecordBuilder
public record Search(OptimizerKind optimizer, int population, long seed, OperatorSet operators,
        double gaussianDeviation, Integer starts, Aggregate judge) implements SearchBuilder.With {

    /** Elites of 150 selected chromosomes (thesis 2.6). */
    private static final double ELITE_SHARE = 30.0 / 150.0;

    /**
     * Checks the ranges and fills in defaults.
     *
     * @throws io.natator.base.InvalidInputException naming the setting that is out of range
     */
    public Search {
        optimizer = optimizer == null ? OptimizerKind.JGAP : optimizer;
        operators = operators == null ? OperatorSet.CORRECTED : operators;
        Limits.require(population >= 2 && population <= Limits.POPULATION, "population", population,
                "a whole number from 2 to " + Limits.POPULATION);
        Limits.require(gaussianDeviation > 0 && gaussianDeviation <= 1, "gaussian-deviation", gaussianDeviation,
                "a number above 0 and up to 1");
        starts = starts == null ? 1 : starts;
        judge = judge == null ? Aggregate.MEAN : judge;
        Limits.require(starts >= 1 && starts <= Limits.STARTS, "starts", starts,
                "a whole number from 1 to " + Limits.STARTS);
        Limits.require(starts >= judge.leastRuns(), "starts", starts,
                "at least " + judge.leastRuns() + " with --judge " + Json.name(judge));
    }

    /** Runs of a generation that go to the best gaits so far, to know them better; none with a single start. */
    public int repeats() {
        return starts == 1 ? 0 : Math.max(elites(), 1) * starts;
    }

    /** How many of the selected are the best; 30 of 150 as in the thesis, the same share of other populations. */
    public int elites() {
        return (int) Math.round(ELITE_SHARE * population);
    }
}
