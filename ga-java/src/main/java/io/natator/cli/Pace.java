package io.natator.cli;

import io.natator.config.EvolutionSettings;
import io.natator.config.OptimizerKind;
import java.util.function.LongSupplier;

/** How fast an evolution goes and how long it will still take, judged by the simulations so far. */
final class Pace {

    private static final double NANOSECONDS = 1e9;
    /** New chromosomes of a generation as a share of the population, before one is known (measured on JGAP: 1.49). */
    private static final double CHILDREN_PER_SELECTED = 1.5;

    private final EvolutionSettings settings;
    private final LongSupplier clock;
    private final long started;
    private final long budget;
    private long done;
    private long expected;

    /**
     * Starts the clock.
     *
     * @param before simulations that the run has behind it
     * @param clock  in nanoseconds, as {@link System#nanoTime()}
     */
    Pace(EvolutionSettings settings, long before, LongSupplier clock) {
        this.settings = settings;
        this.budget = settings.evaluations() == null ? Long.MAX_VALUE : settings.evaluations() - before;
        this.clock = clock;
        this.started = clock.getAsLong();
    }

    void generationStarted(int generation, int simulations) {
        boolean unknown = generation == 0 && settings.optimizer() == OptimizerKind.JGAP;
        double later = unknown ? CHILDREN_PER_SELECTED * settings.population() : simulations;
        expected = Math.min(budget, done + simulations
                + Math.round((double) (settings.generations() - generation) * later));
    }

    void evaluated() {
        done++;
    }

    /** Simulations that the whole run will probably need from its start or continuation. */
    long expected() {
        return Math.max(expected, done);
    }

    /** Simulations per second since the start. */
    double rate() {
        double seconds = (clock.getAsLong() - started) / NANOSECONDS;
        return seconds > 0 ? done / seconds : 0.0;
    }

    /** Time left as {@code 1h02m}, {@code 3m10s} or {@code 5s}; {@code ?} before the first simulation. */
    String left() {
        if (rate() == 0.0) {
            return "?";
        }
        return readable(Math.round((expected() - done) / rate()));
    }

    /** A time as {@code 1h02m}, {@code 3m10s} or {@code 5s}. */
    static String readable(long seconds) {
        if (seconds >= 3600) {
            return String.format("%dh%02dm", seconds / 3600, seconds % 3600 / 60);
        }
        return seconds >= 60 ? String.format("%dm%02ds", seconds / 60, seconds % 60) : seconds + "s";
    }
}
