package io.natator.compare;

import io.natator.base.Numbers;
import java.util.List;
import java.util.Objects;
import java.util.stream.Stream;

/** What all runs of a scene have spent when they are compared. */
enum EqualBudget {
    /** The same number of evaluations. */
    EVALUATIONS("evaluations", "") {
        @Override
        double of(RunSummary run) {
            return run.evaluations();
        }
    },
    /** The same simulated time, in seconds: what ends its evaluations early has more of them. */
    SIMULATED_TIME("simulated time", " s") {
        @Override
        double of(RunSummary run) {
            return run.simulated();
        }
    };

    /** Shares of the whole at which runs are compared. */
    static final List<Double> SHARES = List.of(0.1, 0.25, 0.5, 1.0);

    /** From so many seconds on tenths of them mean nothing to a reader. */
    private static final double ROUGH = 100;

    private final String label;
    private final String unit;

    EqualBudget(String label, String unit) {
        this.label = label;
        this.unit = unit;
    }

    /** The budget's name for people. */
    String label() {
        return label;
    }

    /** So much of it: {@code 600}, {@code 37.5 s}. */
    String text(double place) {
        return Numbers.fixed(place, this == SIMULATED_TIME && place < ROUGH ? 1 : 0) + unit;
    }

    /** What a run has spent at its end; NaN if that is not known. */
    abstract double of(RunSummary run);

    /** A share of what all of these runs have spent at least; NaN if that is not known of any. */
    double at(double share, List<RunSummary> runs) {
        double all = runs.stream().mapToDouble(this::of).filter(Double::isFinite).min().orElse(Double.NaN);
        return this == EVALUATIONS ? evaluations(share, (long) all) : share * all;
    }

    /** A share of so many evaluations, at least 1. */
    static int evaluations(double share, long all) {
        return (int) Math.max(1, Math.round(share * all));
    }

    /** The different gaits that led a run where it is compared with all of these, at these shares of either budget. */
    static List<List<Double>> leaders(RunSummary run, List<RunSummary> all, List<Double> shares) {
        return Stream.of(values())
                .flatMap(budget -> shares.stream().map(share -> run.leader(budget, budget.at(share, all))))
                .filter(Objects::nonNull).distinct().toList();
    }
}
