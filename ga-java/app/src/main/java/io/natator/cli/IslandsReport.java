package io.natator.cli;

import io.natator.checkpoint.Archipelago;
import io.natator.checkpoint.StoredRun;
import io.natator.config.Migration;
import io.natator.evolution.EvolutionState;
import java.io.PrintWriter;
import java.nio.file.Path;

/** How the islands of an archipelago stand, in words. */
final class IslandsReport {

    private static final String ROW = "  %-8s%-8s%-12s%-13s%-10s%s%n";

    private IslandsReport() {
    }

    /** On one line, what makes several islands of a run. */
    static String exchange(Archipelago.Plan plan) {
        return plan.islands() + " islands, seeds " + plan.settings().seed() + " to " + plan.settings(plan.islands()).seed()
                + (plan.migrants() == 0 ? "; none exchanges gaits" : "; after every " + generations(plan.every()) + " the best "
                + (plan.migrants() == 1 ? "gait" : plan.migrants() + " gaits") + " of each go" + (plan.migrants() == 1 ? "es" : "")
                + " to the next");
    }

    private static String generations(int every) {
        return every == 1 ? "generation" : every + " generations";
    }

    /** A row for each island that has begun, and which of them is the winner's. */
    static void print(Archipelago archipelago, PrintWriter out) {
        out.println(exchange(archipelago.plan()));
        out.printf(ROW, "island", "seed", "generation", "evaluations", "best", "came from others");
        int winner = archipelago.winner();
        for (int i = 1; i <= archipelago.plan().islands(); i++) {
            Path folder = archipelago.folder(i);
            EvolutionState state = StoredRun.exists(folder) ? StoredRun.state(folder) : null;
            boolean hasGait = state != null && state.best() != null;
            out.printf(ROW, i, archipelago.plan().settings(i).seed(), state == null ? "-" : state.generation(),
                    state == null ? "-" : state.evaluations(), hasGait ? archipelago.plan().settings(i).worthText(state.best().score()) : "-",
                    (state == null ? 0 : arrived(archipelago, i, state)) + (i == winner && hasGait ? "   winner" : ""));
        }
    }

    /** Gaits that an island has got from the one before it. */
    private static long arrived(Archipelago archipelago, int island, EvolutionState state) {
        Migration migration = archipelago.plan().settings(island).migration();
        return migration == null ? 0 : StoredRun.departures(archipelago.folder(migration.before())).stream()
                .filter(one -> one.generation() < state.generation()).mapToInt(one -> one.migrants().size()).sum();
    }
}
