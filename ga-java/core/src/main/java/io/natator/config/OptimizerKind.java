package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;

/** What searches for the best gait. */
public enum OptimizerKind {
    /** The thesis' genetic algorithm (2.6) on JGAP. */
    @JsonProperty("jgap")
    JGAP,
    /** Covariance matrix adaptation (Hansen and Ostermeier 2001), by Hipparchus. */
    @JsonProperty("cma-es")
    CMA_ES,
    /** Uniformly random genes: what the others are to be better than. */
    @JsonProperty("random")
    RANDOM,
    /** NSGA-II (Deb, Pratap, Agarwal, Meyarivan 2002) on jMetal, for several objectives at once. */
    @JsonProperty("nsga2")
    NSGA2,
    /** MAP-Elites (Mouret and Clune 2015): the best gait of every kind. */
    @JsonProperty("map-elites")
    MAP_ELITES
}
