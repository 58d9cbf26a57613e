package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;

/** What selection rewards. */
public enum FitnessKind {
    /** The distance swum forwards (thesis 2.6). */
    @JsonProperty("distance")
    DISTANCE,
    /** The distance less what the same gait drifts forwards in vacuum in the same time, which is no swimming. */
    @JsonProperty("net")
    NET
}
