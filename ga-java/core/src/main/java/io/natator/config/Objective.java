package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;

/** What a gait can be good at; more is better in each. */
public enum Objective {
    /** The distance swum along x (thesis 2.6), in scene units. */
    @JsonProperty("distance")
    DISTANCE,
    /** The distance swum along x less what the gait drifts forwards in vacuum, in scene units. */
    @JsonProperty("net")
    NET,
    /** The way along the body's own heading, in scene units: one that swims on an arc loses nothing by it. */
    @JsonProperty("forward")
    FORWARD,
    /** How little it turned and rolled: less the sum of yaw and roll at the end, in radians. */
    @JsonProperty("straight")
    STRAIGHT,
    /** How little its muscles worked: less their work, in mass times length squared by seconds squared. */
    @JsonProperty("work")
    WORK,
    /** Distance by work: one by the cost of transport, so that what stays where it is has none. */
    @JsonProperty("efficiency")
    EFFICIENCY,
    /** The weighted sum of the scores of the scene's own goals. */
    @JsonProperty("goals")
    GOALS
}
