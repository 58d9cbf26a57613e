package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;

/** What an evolution changes. */
public enum Evolved {
    /** How the scene's body moves. */
    @JsonProperty("gait")
    GAIT,
    /** The body, which swims with a given gait. */
    @JsonProperty("body")
    BODY,
    /** Both together. */
    @JsonProperty("both")
    BOTH
}
