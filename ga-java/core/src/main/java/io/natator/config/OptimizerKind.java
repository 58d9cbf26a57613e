package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;
import java.util.Set;

/** What searches for the best gait. What the rest of the program must know of an optimizer is told by its kind. */
public enum OptimizerKind {
    /** The thesis' genetic algorithm (2.6) on JGAP. */
    @JsonProperty("jgap")
    JGAP(Trait.GENETIC_OPERATORS),
    /** Covariance matrix adaptation (Hansen and Ostermeier 2001), by Hipparchus. */
    @JsonProperty("cma-es")
    CMA_ES(Trait.WHOLE_HISTORY),
    /** Uniformly random genes: what the others are to be better than. */
    @JsonProperty("random")
    RANDOM,
    /** NSGA-II (Deb, Pratap, Agarwal, Meyarivan 2002) on jMetal, for several objectives at once. */
    @JsonProperty("nsga2")
    NSGA2(Trait.SEVERAL_OBJECTIVES),
    /** MAP-Elites (Mouret and Clune 2015): the best gait of every kind. */
    @JsonProperty("map-elites")
    MAP_ELITES(Trait.KINDS),
    /** Another program, which asks and is told over a pipe. */
    @JsonProperty("external")
    EXTERNAL(Trait.WHOLE_HISTORY, Trait.OUTSIDE);

    private final Set<Trait> traits;

    private enum Trait {
        GENETIC_OPERATORS, WHOLE_HISTORY, SEVERAL_OBJECTIVES, KINDS, OUTSIDE
    }

    OptimizerKind(Trait... traits) {
        this.traits = Set.of(traits);
    }

    /** Whether it works by the genetic operators of the settings, whose children differ in number from generation to generation. */
    public boolean usesOperators() {
        return traits.contains(Trait.GENETIC_OPERATORS);
    }

    /** Whether a run goes on only by all its evaluations, not by its last population. */
    public boolean needsAllEvaluations() {
        return traits.contains(Trait.WHOLE_HISTORY);
    }

    /** Whether it takes several objectives without weights, and judges gaits by the means of their runs. */
    public boolean takesSeveralObjectives() {
        return traits.contains(Trait.SEVERAL_OBJECTIVES);
    }

    /** Whether it keeps the best gait of each kind, told by the effort of the swim. */
    public boolean mapsKinds() {
        return traits.contains(Trait.KINDS);
    }

    /** Whether it is another program, which may propose otherwise when a run continues and it is asked again. */
    public boolean isOutside() {
        return traits.contains(Trait.OUTSIDE);
    }
}
