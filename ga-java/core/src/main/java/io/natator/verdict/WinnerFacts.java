package io.natator.verdict;

import io.natator.base.Numbers;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.Convergence;
import io.natator.checkpoint.SwimSample;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SwimmingNumbers;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * What a reader wants to know of a winner, in words: whether it swims, how fast, how sure that is, what it lost since it was
 * selected, and what it costs.
 */
public final class WinnerFacts {

    private static final int DIGITS = 3;
    private static final double WORTH_TELLING = 0.01; // body volumes of cavities
    private static final double MIN_ACROSS = 3.99; // spacings of the water, less rounding, that a body needs

    private WinnerFacts() {
    }

    /**
     * Rows of name and text, the verdict first; what is not known is left out.
     *
     * @param run folder of it, for what {@code natator check} and {@code natator converge} found
     */
    public static Map<String, String> of(Path run, BestGait best) {
        Map<String, String> facts = new LinkedHashMap<>();
        facts.put("verdict", Verdict.of(best).text() + (best.fresh() == null ? " (one run, not a mean)" : ""));
        Controls controls = Controls.of(run, best.swimmer());
        Convergence convergence = Convergence.of(run, best.swimmer());
        if (controls != null) {
            facts.put("controls", ControlVerdict.of(controls, convergence).text());
        }
        if (convergence != null) {
            facts.put("finer steps", ConvergenceText.of(convergence));
        }
        Map<String, String> fresh = FreshText.of(best);
        for (String about : List.of("speed", "distance", "half step", "selected")) {
            if (fresh.containsKey(about)) {
                facts.put(about, fresh.get(about));
            }
        }
        facts.putAll(mechanics(best));
        return facts;
    }

    /** What it costs ({@code cost}) and how it compares with animals of other sizes ({@code flow}), as far as that is known. */
    public static Map<String, String> mechanics(BestGait best) {
        Map<String, String> facts = new LinkedHashMap<>();
        if (best.fresh() != null) {
            SwimSample base = best.fresh().base();
            put(facts, "cost", cost(base.work(), base.costOfTransport()));
            put(facts, "flow",
                    numbers(base.reynolds(), base.strouhal(), base.cavities(), across(best.result().swimming())));
        } else {
            SimulationResult one = best.result();
            SwimmingNumbers numbers = one.swimming();
            put(facts, "cost", cost(one.work(),
                    one.work() == null || one.distanceOrZero() <= 0 ? null : one.work() / one.distance()));
            put(facts, "flow", numbers == null ? List.of()
                    : numbers(numbers.reynolds(), numbers.strouhal(), numbers.cavities(), across(numbers)));
        }
        return facts;
    }

    private static List<String> cost(Double work, Double transport) {
        List<String> parts = new ArrayList<>();
        if (transport != null) {
            parts.add("cost of transport " + Numbers.significant(transport, DIGITS) + " mass · length/s²");
        }
        if (work != null) {
            parts.add("work of the muscles " + Numbers.significant(work, DIGITS) + " mass · length²/s²");
        }
        return parts;
    }

    /** Spacings of the water across the body: the same in all its runs. */
    private static Double across(SwimmingNumbers one) {
        return one == null ? null : one.across();
    }

    private static List<String> numbers(Double reynolds, Double strouhal, Double cavities, Double across) {
        List<String> parts = new ArrayList<>();
        if (reynolds != null) {
            parts.add("Reynolds number " + Numbers.significant(reynolds, DIGITS));
        }
        if (strouhal != null) {
            parts.add("Strouhal number " + Numbers.significant(strouhal, DIGITS));
        }
        if (cavities != null && cavities >= WORTH_TELLING) {
            parts.add("cavities in the water " + Numbers.significant(cavities, DIGITS) + " body volumes");
        }
        if (across != null && across > 0 && across < MIN_ACROSS) {
            parts.add("body " + Numbers.significant(across, 2) + " spacings of the water across");
        }
        return parts;
    }

    private static void put(Map<String, String> facts, String about, List<String> parts) {
        if (!parts.isEmpty()) {
            facts.put(about, String.join(", ", parts));
        }
    }
}
