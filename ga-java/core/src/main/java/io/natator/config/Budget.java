package io.natator.config;

import io.soabase.recordbuilder.core.RecordBuilder;

/**
 * How far a run goes, and on what: all that may change while it is under way.
 *
 * @param generations       generations bred after the random one, at least 0 (thesis: 100)
 * @param evaluations       simulations after which the run ends, within a generation if need be, at least 1; null for
 *                          as many as the generations take
 * @param backend           what the simulator computes on
 */
@RecordBuilder
public record Budget(int generations, Long evaluations, Backend backend) implements BudgetBuilder.With {

    /** Generations of a run that ends by its number of evaluations alone. */
    public static final int NO_LIMIT = Integer.MAX_VALUE;

    /**
     * Checks the ranges and fills in defaults.
     *
     * @throws io.natator.base.InvalidInputException naming the setting that is out of range
     */
    public Budget {
        Limits.require(generations >= 0, "generations", generations, "a whole number from 0");
        Limits.require(evaluations == null || evaluations >= 1, "evaluations", evaluations, "a whole number from 1");
        backend = backend == null ? Backend.CPU : backend;
    }
}
