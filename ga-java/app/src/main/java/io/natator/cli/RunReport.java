package io.natator.cli;

import io.natator.base.Numbers;
import io.natator.body.BodyText;
import io.natator.body.ProfileBody;
import io.natator.checkpoint.BestGait;
import io.natator.config.EvolutionSettings;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.GenerationSummary;
import io.natator.file.ShellWord;
import io.natator.protocol.SimulationResult;
import io.natator.verdict.FreshText;
import io.natator.verdict.Refusals;
import io.natator.verdict.Verdict;
import io.natator.verdict.WinnerFacts;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;

/** The best gait of a run, in words. */
record RunReport(PrintWriter out) {

    static final int DIGITS = 4;

    /**
     * Prints it.
     *
     * @param best   null if no gait was measured
     * @param folder where the run is
     */
    void print(EvolutionSettings settings, EvolutionState state, BestGait best, Path folder) {
        if (best == null) {
            out.println("no gait was measured in " + Numbers.count(state.evaluations(), "evaluation")
                    + ": unstable, refused or failed");
            printRefusals(state);
            return;
        }
        out.println("best " + (settings.problem().evolve() == null ? "gait" : "swimmer") + " of "
                + settings.problem().scene() + " after " + Numbers.count(state.generation(), "generation") + " and "
                + Numbers.count(state.evaluations(), "evaluation"));
        line("frequency", number(best.gait().frequency()) + " 1/s");
        line("amplitude", row(best.gait().amplitude()));
        line("phase", row(best.gait().phase()));
        if (best.gait().offset() != null) {
            line("offset", row(best.gait().offset()));
        }
        if (settings.problem().evolve() != null) {
            ProfileBody scene = settings.problem().evolve().body();
            BodyText.of(scene.with(best.body()), scene).forEach(this::line);
        }
        SimulationResult water = best.result();
        Map<String, String> fresh = FreshText.of(best);
        fresh.forEach(this::line);
        if (fresh.isEmpty()) {
            line("distance", number(best.distance()) + " in " + Numbers.fixed(water.simulated(), 2) + " s ("
                    + water.stopped() + ", one run)");
        }
        if (water.vacuumDrift() != null) {
            line("net", number(water.score()) + ": " + number(water.vacuumDrift())
                    + " of it is drift, by the same time in vacuum");
        }
        if (fresh.isEmpty()) {
            line("speed", number(best.speed()) + " units/s");
        }
        WinnerFacts.mechanics(best).forEach(this::line);
        printVacuum(best.vacuum());
        Verdict verdict = Verdict.of(best);
        line("verdict", verdict.text() + (fresh.isEmpty() ? " (one run, not a mean)" : ""));
        if (verdict.advice() != null) {
            line("", verdict.advice());
        }
        printRefusals(state);
        printFailures(state, folder);
        line("watch it", Main.asCalled() + " view --run " + ShellWord.of(folder));
        line("share it", Main.asCalled() + " page " + ShellWord.of(folder));
    }

    private void printVacuum(SimulationResult vacuum) {
        if (vacuum == null) {
            return;
        }
        line("in vacuum", vacuum.status() == SimulationResult.Status.OK
                ? number(vacuum.distance()) + " in " + Numbers.fixed(vacuum.simulated(), 2) + " s, "
                        + number(vacuum.speed()) + " units/s"
                : "no result: " + (vacuum.error() != null ? vacuum.error() : vacuum.status()));
    }

    /** Evaluations that broke laws of mechanics, from which nothing is selected. */
    private void printRefusals(EvolutionState state) {
        String refused = Refusals.of(state);
        if (refused != null) {
            line("unstable", refused);
        }
    }

    /** A search that lacks some answers may end elsewhere than one that has them. */
    private void printFailures(EvolutionState state, Path folder) {
        int failed = state.history().stream().mapToInt(GenerationSummary::failed).sum();
        if (failed > 0) {
            line("failed",
                    failed + " of " + Numbers.count(state.evaluations(), "evaluation")
                            + " gave no answer, so the same seed may "
                            + "find another gait elsewhere; why: " + Main.asCalled() + " show " + ShellWord.of(folder));
        }
    }

    private void line(String name, String value) {
        out.printf("  %-11s %s%n", name, value);
    }

    static String number(double value) {
        return Numbers.fixed(value, DIGITS);
    }

    static String row(List<Double> values) {
        return values.stream().map(RunReport::number).collect(Collectors.joining(" "));
    }
}
