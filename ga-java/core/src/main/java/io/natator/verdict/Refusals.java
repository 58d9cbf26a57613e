package io.natator.verdict;

import io.natator.base.Numbers;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.GenerationSummary;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/** What a run did not select from, since it broke laws of mechanics, in words. */
public final class Refusals {

    private Refusals() {
    }

    /** On one line: how many evaluations, and which laws they broke, the most often broken first; null if none did. */
    public static String of(EvolutionState state) {
        Map<String, Integer> laws = new TreeMap<>();
        for (GenerationSummary one : state.history()) {
            one.brokenLaws().forEach((law, count) -> laws.merge(law, count, Integer::sum));
        }
        if (laws.isEmpty()) {
            return null;
        }
        List<String> parts = new ArrayList<>();
        laws.entrySet().stream().sorted(Map.Entry.<String, Integer>comparingByValue(Comparator.reverseOrder()))
                .forEach(one -> parts.add(one.getValue() + (parts.isEmpty() ? " broke law " : " ") + one.getKey()));
        int all = laws.values().stream().mapToInt(Integer::intValue).sum();
        return "refused " + all + " of " + Numbers.count(state.evaluations(), "evaluation") + ": "
                + String.join(", ", parts);
    }
}
