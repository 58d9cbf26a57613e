package io.natator.evolution;

import java.util.List;

/**
 * Simulations that the earlier part of a run has left.
 *
 * @param first id of the first of them; more than 0 where those before were dropped since they are not needed to go on
 * @param rows  those with the ids {@code first}, {@code first} + 1, …
 */
public record RecordedEvaluations(long first, List<EvaluationRecord> rows) {

    /** Copies the list. */
    public RecordedEvaluations {
        rows = List.copyOf(rows);
    }

    /** Id of the next simulation: how many there were, the dropped ones included. */
    public long end() {
        return first + rows.size();
    }

    /** The evaluation with this id, at least {@code first} and below {@link #end}. */
    public EvaluationRecord get(long id) {
        return rows.get((int) (id - first));
    }

    /** Those with ids from {@code from}, or from {@code first} if that is more, and below {@code to}. */
    public List<EvaluationRecord> between(long from, long to) {
        int begin = (int) Math.max(from - first, 0);
        return rows.subList(begin, Math.max((int) (to - first), begin));
    }
}
