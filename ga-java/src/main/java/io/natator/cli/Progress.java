package io.natator.cli;

import io.natator.analysis.GenerationSummary;
import io.natator.config.EvolutionSettings;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import java.io.PrintWriter;
import java.util.Locale;
import me.tongfei.progressbar.ConsoleProgressBarConsumer;
import me.tongfei.progressbar.ProgressBar;
import me.tongfei.progressbar.ProgressBarBuilder;
import me.tongfei.progressbar.ProgressBarStyle;

/** Tells how an evolution goes: by a bar on a terminal, by one line per generation elsewhere. */
final class Progress implements EvolutionListener, AutoCloseable {

    private static final int BAR_WIDTH = 110;

    private final String generations;
    private final Pace pace;
    private final PrintWriter out;
    private final ProgressBar bar;

    /**
     * Starts the clock.
     *
     * @param before   simulations that the run has behind it
     * @param out      for the lines
     * @param terminal whether to draw a bar instead, on standard error
     */
    Progress(EvolutionSettings settings, long before, PrintWriter out, boolean terminal) {
        this.generations = settings.generations() == EvolutionSettings.NO_LIMIT ? "" : "/" + settings.generations();
        this.pace = new Pace(settings, before, System::nanoTime);
        this.out = out;
        // A consumer of fixed width: the usual one measures the terminal by JLine, which takes Ctrl-C away from us.
        this.bar = terminal ? new ProgressBarBuilder().setTaskName("").setInitialMax(1)
                .setConsumer(new ConsoleProgressBarConsumer(System.err, BAR_WIDTH))
                .setStyle(ProgressBarStyle.ASCII).showSpeed().build() : null;
    }

    @Override
    public void generationStarted(int generation, int simulations) {
        pace.generationStarted(generation, simulations);
        if (bar != null) {
            bar.maxHint(pace.expected());
        }
    }

    @Override
    public void evaluated(EvaluationRecord evaluation) {
        pace.evaluated();
        if (bar != null) {
            bar.step();
        }
    }

    @Override
    public void generationFinished(EvolutionState state) {
        GenerationSummary last = state.history().get(state.history().size() - 1);
        if (bar != null) {
            bar.setExtraMessage(String.format(Locale.ROOT, " gen %d%s best %.4f mean %.4f", last.generation(),
                    generations, last.best(), last.mean()));
            return;
        }
        out.printf(Locale.ROOT, "generation %d%s  best %.4f  mean %.4f  evaluations %d  %.1f/s  left %s%n",
                last.generation(), generations, last.best(), last.mean(), state.evaluations(), pace.rate(),
                pace.left());
        out.flush();
    }

    @Override
    public void close() {
        if (bar != null) {
            bar.close();
        }
    }
}
