package io.natator.cli;

import io.natator.config.Budget;
import io.natator.config.EvolutionSettings;
import io.natator.evolution.EvolutionState;
import java.util.function.LongSupplier;

/** How far an evolution is, how fast it goes and how long it will still take, judged by the simulations so far. */
final class ProgressEstimate {

    /** New chromosomes of a generation as a share of the population (JGAP, in the 24 runs of results/thesis: 1.71). */
    static final double CHILDREN_PER_SELECTED = 1.7;

    private static final double NANOSECONDS = 1e9;
    private final EvolutionSettings settings;
    private final LongSupplier clock;
    private final long started;
    private final long recorded;
    private long done;
    private long expected;
    private boolean certain;

    /** The pace of a run that begins now. */
    ProgressEstimate(EvolutionSettings settings, LongSupplier clock) {
        this(settings, null, 0, clock);
    }

    /**
     * Starts the clock.
     *
     * @param from     where the run continues, or null
     * @param recorded simulations that it has behind it; those after {@code from} are announced again, at once
     * @param clock    in nanoseconds, as {@link System#nanoTime()}
     */
    ProgressEstimate(EvolutionSettings settings, EvolutionState from, long recorded, LongSupplier clock) {
        this.settings = settings;
        this.recorded = recorded;
        this.clock = clock;
        this.started = clock.getAsLong();
        if (from != null) {
            done = from.evaluations();
        }
        estimate(from == null ? perGeneration(1) : done,
                settings.budget().generations() - (from == null ? 0 : from.generation()));
    }

    /** A generation needs so many simulations. */
    void generationStarted(int generation, int simulations) {
        estimate(done + simulations, settings.budget().generations() - generation);
    }

    /** Simulations of a generation with so many newborns for each place in the population. */
    private double perGeneration(double newborns) {
        return newborns * settings.search().population() * settings.search().starts() + settings.search().repeats();
    }

    /**
     * Estimates the total.
     *
     * @param known simulations done or known to be needed
     * @param later generations of which nothing is known yet
     */
    private void estimate(double known, int later) {
        long budget = settings.budget().evaluations() == null ? Long.MAX_VALUE : settings.budget().evaluations();
        boolean varies = settings.search().optimizer().usesOperators();
        certain = !varies || later == 0 || settings.budget().generations() == Budget.NO_LIMIT;
        expected = Math.round(Math.min(budget, known + later * perGeneration(varies ? CHILDREN_PER_SELECTED : 1)));
    }

    /** A simulation has ended. */
    void evaluated() {
        done++;
    }

    /** Simulations since the run's start, those before it was continued included. */
    long done() {
        return done;
    }

    /** Simulations that the whole run will probably need. */
    long expected() {
        return Math.max(expected, done);
    }

    /** {@link #expected()} with a word for how sure that is: {@code 340}, {@code about 340}, {@code at most 340}. */
    String total() {
        boolean limited = settings.budget().evaluations() != null && expected() == settings.budget().evaluations();
        return (certain ? "" : limited ? "at most " : "about ") + expected();
    }

    /** How much of the run is done, in percent. */
    long percent() {
        return expected() == 0 ? 0 : 100 * done / expected();
    }

    /** Simulations per second since the start or continuation. */
    double rate() {
        return seconds() > 0 ? Math.max(done - recorded, 0) / seconds() : 0.0;
    }

    private double seconds() {
        return (clock.getAsLong() - started) / NANOSECONDS;
    }

    /** Time since the start or continuation, as {@link #readable}. */
    String elapsed() {
        return readable(Math.round(seconds()));
    }

    /** Time left, as {@link #readable}; {@code ?} before the first simulation. */
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
