package io.natator.verdict;

import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.SwimSample;
import io.natator.config.Numbers;
import io.natator.simulator.SimulationResult;
import io.natator.simulator.SwimmingNumbers;
import java.util.ArrayList;
import java.util.List;

/** How a swim compares with that of animals of other sizes, and what it cost, in words. */
public final class Mechanics {

    private static final int DIGITS = 3;

    private Mechanics() {
    }

    /** On one line, as far as a result tells: {@code Re 131, St 0.313, swimming number 410, work 0.75}; else null. */
    public static String of(SimulationResult result) {
        List<String> parts = new ArrayList<>();
        SwimmingNumbers numbers = result.swimming();
        if (numbers != null) {
            add(parts, "Re", numbers.reynolds());
            add(parts, "St", numbers.strouhal());
            add(parts, "swimming number", numbers.swimmingNumber());
        }
        add(parts, "work", result.work());
        return parts.isEmpty() ? null : String.join(", ", parts);
    }

    /** Of a run's best gait: means over its fresh runs, else of its one run. */
    public static String of(BestGait best) {
        if (best.fresh() == null) {
            return of(best.result());
        }
        SwimSample base = best.fresh().base();
        List<String> parts = new ArrayList<>();
        add(parts, "Re", base.reynolds());
        add(parts, "St", base.strouhal());
        add(parts, "work", base.work());
        add(parts, "cost of transport", base.costOfTransport());
        return parts.isEmpty() ? null : String.join(", ", parts);
    }

    private static void add(List<String> parts, String name, Double value) {
        if (value != null) {
            parts.add(name + " " + Numbers.significant(value, DIGITS));
        }
    }
}
