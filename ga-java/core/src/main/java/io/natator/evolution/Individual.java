package io.natator.evolution;

import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.protocol.Effort;
import io.natator.protocol.SimulationResult;
import io.soabase.recordbuilder.core.RecordBuilder;
import java.util.List;
import java.util.Objects;

/**
 * An evaluated chromosome.
 *
 * @param genes    gene values in the order of the encoding
 * @param age      generations survived since birth; random first ones start at 1, since JGAP does not cross newborns
 * @param result   what came of its evaluation; of several runs, of the first that was measured
 * @param estimate what it is worth by several runs; null where there is one
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
@RecordBuilder
public record Individual(List<Double> genes, int age, SimulationResult result, Estimate estimate)
        implements IndividualBuilder.With {

    private static final double NEXT_TO_NOTHING = 1e-9;

    /** Copies the genes; requires them and a result with its id. */
    public Individual {
        genes = List.copyOf(Objects.requireNonNull(genes, "genes"));
        Objects.requireNonNull(result, "result");
        Objects.requireNonNull(result.id(), "id");
    }

    /** An individual of a single run. */
    public Individual(List<Double> genes, int age, SimulationResult result) {
        this(genes, age, result, null);
    }

    /** What is to be great; negative for what goes backwards. */
    public double score() {
        return estimate == null ? result.score() : estimate.score();
    }

    /**
     * The score that selection works with: never negative, and 0 for what was not measured, as for who goes backwards. Where
     * more than the distance counts all scores may be below 0, as where work has a price: these are next to nothing, in their
     * order.
     */
    public double fitness() {
        if (!isMeasured()) {
            return 0.0;
        }
        if (isDistance()) {
            return Math.max(score(), 0.0);
        }
        return score() > 0 ? score() + NEXT_TO_NOTHING : NEXT_TO_NOTHING / (1 - score());
    }

    /** Whether its score is how far it came, and not what goals or objectives make of that. */
    boolean isDistance() {
        return objectives() == null && result.goals() == null;
    }

    /** What it is worth by each of the run's objectives; null where it has none. */
    public List<Double> objectives() {
        return estimate == null ? result.objectives() : estimate.objectives();
    }

    /** What its runs took together; null where nobody asked. */
    public Effort effort() {
        return estimate == null ? result.effort() : estimate.effort();
    }

    /** How many runs the score rests on. */
    public int runs() {
        return estimate == null ? 1 : estimate.runs().size();
    }

    /** Whether it can be selected: any run came to a distance, and none was unstable. */
    boolean isMeasured() {
        return result.status() == SimulationResult.Status.OK && isStable();
    }

    /** Whether none of its runs broke a law of mechanics. */
    boolean isStable() {
        return result.status() != SimulationResult.Status.UNSTABLE && (estimate == null || estimate.isStable());
    }
}
