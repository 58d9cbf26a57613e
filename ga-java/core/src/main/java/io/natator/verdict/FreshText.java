package io.natator.verdict;

import io.natator.base.Numbers;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.FreshRuns;
import io.natator.checkpoint.Spread;
import io.natator.checkpoint.SwimSample;
import io.natator.config.Aggregate;
import java.util.LinkedHashMap;
import java.util.Locale;
import java.util.Map;
import java.util.stream.Collectors;

/** What a winner does from fresh starts, in words; after each ± stands a standard deviation. */
public final class FreshText {

    private FreshText() {
    }

    /** Rows of name and text: distance, half step, goals, speed, selected. Empty without fresh runs. */
    public static Map<String, String> of(BestGait best) {
        Map<String, String> lines = new LinkedHashMap<>();
        FreshRuns fresh = best.fresh();
        if (fresh == null) {
            return lines;
        }
        SwimSample base = fresh.base();
        lines.put("distance", spread(base.distance(), 4) + " in " + Numbers.fixed(fresh.duration(), 2) + " s; "
                + ends(base));
        if (fresh.halfStep() != null) {
            SwimSample half = fresh.halfStep();
            lines.put("half step", spread(half.distance(), 4) + " at half the time step; " + ends(half)
                    + (half.bodyLengths() == null ? "" : "; " + spread(half.bodyLengths(), 3) + " body lengths/s"));
        }
        if (base.goals() != null) {
            SwimSample half = fresh.halfStep();
            lines.put("goals", "score " + spread(base.goals(), 4) + (half == null || half.goals() == null ? ""
                    : "; " + spread(half.goals(), 4) + " at half the time step"));
        }
        lines.put("speed", spread(base.speed(), 4) + " units/s" + (base.bodyLengths() == null ? ""
                : ", " + spread(base.bodyLengths(), 3) + " body lengths/s, " + spread(base.perBeat(), 3)
                        + " per beat"));
        lines.put("selected", Numbers.worth(fresh.selected()) + " by " + (fresh.selectedRuns() == 1 ? "one run"
                : judge(fresh.judge()) + " of " + fresh.selectedRuns() + " runs") + ", "
                + (fresh.judge() == Aggregate.MEAN ? "" : judge(fresh.judge()) + " ") + Numbers.worth(fresh.again())
                + " again" + (fresh.selectionLoss() == null ? ""
                        : ": selection loss " + Numbers.fixed(100 * fresh.selectionLoss(), 1) + " %"));
        return lines;
    }

    /** How many runs, and how they ended. */
    private static String ends(SwimSample sample) {
        return sample.runs() + " fresh starts, " + sample.stopped().entrySet().stream()
                .map(end -> (end.getValue() == sample.runs() ? "all" : end.getValue().toString()) + " " + end.getKey())
                .collect(Collectors.joining(", "));
    }

    private static String judge(Aggregate judge) {
        return judge.name().toLowerCase(Locale.ROOT).replace('_', ' ');
    }

    private static String spread(Spread spread, int digits) {
        return Numbers.withError(spread.mean(), spread.sd(), digits);
    }
}
