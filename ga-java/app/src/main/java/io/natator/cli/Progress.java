package io.natator.cli;

import io.natator.config.Budget;
import io.natator.config.EvolutionSettings;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.GenerationSummary;
import io.natator.protocol.SimulationResult;
import java.io.PrintStream;
import java.io.PrintWriter;
import java.util.Locale;
import java.util.function.LongSupplier;
import me.tongfei.progressbar.ConsoleProgressBarConsumer;
import me.tongfei.progressbar.ProgressBar;
import me.tongfei.progressbar.ProgressBarBuilder;

/**
 * Tells how an evolution goes, counted from the run's start whether it was continued or not: by one line that changes
 * on a terminal; elsewhere by a line for each generation, and every few seconds one in between.
 */
final class Progress implements EvolutionListener, AutoCloseable {

    private static final int WIDTH = 118;
    private static final int CELLS = 10;
    private static final long INTERVAL_NANOSECONDS = 10_000_000_000L;

    private final EvolutionSettings settings;
    private final ProgressEstimate estimate;
    private final LongSupplier clock;
    private final PrintWriter out;
    private final ProgressBar bar;
    private long said;
    private int generation;
    private Double best;

    /**
     * Starts the clock.
     *
     * @param from     where the run continues, or null
     * @param recorded simulations that the run has behind it
     * @param out      for the lines
     * @param terminal for one line that changes, or null for a line each
     */
    Progress(EvolutionSettings settings, EvolutionState from, long recorded, PrintWriter out, PrintStream terminal) {
        this(settings, from, recorded, out, terminal, System::nanoTime);
    }

    /** With a clock in nanoseconds. */
    Progress(EvolutionSettings settings, EvolutionState from, long recorded, PrintWriter out, PrintStream terminal,
            LongSupplier clock) {
        this.settings = settings;
        this.estimate = new ProgressEstimate(settings, from, recorded, clock);
        this.clock = clock;
        this.out = out;
        this.said = clock.getAsLong();
        if (from != null) {
            generation = from.generation();
            best = from.best() == null ? null : from.best().score();
        }
        // A consumer of fixed width: the usual one measures the terminal by JLine, which takes Ctrl-C away from us.
        this.bar = terminal == null ? null : new ProgressBarBuilder().setInitialMax(1)
                .setConsumer(new ConsoleProgressBarConsumer(terminal, WIDTH))
                .setRenderer((state, width) -> barLine()).build();
    }

    @Override
    public synchronized void generationStarted(int number, int simulations) {
        generation = number;
        estimate.generationStarted(number, simulations);
    }

    @Override
    public synchronized void evaluated(EvaluationRecord evaluation) {
        estimate.evaluated();
        SimulationResult result = evaluation.result();
        // Of several starts, one run says little: there the generation's end tells.
        if (settings.search().starts() == 1 && result.status() == SimulationResult.Status.OK
                && (best == null || result.score() > best)) {
            best = result.score();
        }
        if (bar == null && clock.getAsLong() - said >= INTERVAL_NANOSECONDS) {
            say(generation() + " under way, " + counts());
        }
    }

    @Override
    public synchronized void generationFinished(EvolutionState state) {
        if (settings.search().starts() > 1) {
            best = state.best() == null ? null : state.best().score();
        }
        if (bar == null) {
            GenerationSummary last = state.history().get(state.history().size() - 1);
            say(generation() + ", mean " + settings.problem().worthText(last.mean()) + ", " + counts());
        }
    }

    private void say(String line) {
        said = clock.getAsLong();
        out.println(line);
        out.flush();
    }

    /** For the terminal, from the bar's own thread. */
    private synchronized String barLine() {
        int full = (int) (CELLS * estimate.percent() / 100);
        return String.format(Locale.ROOT, "%3d %% [%s%s] %s, %s", estimate.percent(), "=".repeat(full),
                " ".repeat(CELLS - full), generation(), counts());
    }

    private String generation() {
        return "generation " + generation
                + (settings.budget().generations() == Budget.NO_LIMIT ? "" : " of " + settings.budget().generations());
    }

    private String counts() {
        return String.format(Locale.ROOT, "best %s, evaluations %d of %s, elapsed %s, left %s",
                best == null ? "-" : settings.problem().worthText(best), estimate.done(), estimate.total(),
                estimate.elapsed(), estimate.left());
    }

    @Override
    public void close() {
        if (bar != null) {
            bar.close();
        }
    }
}
