package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;

/** How the simulator solves a step. */
public enum Scheme {
    /** As NVIDIA Flex 1.2.0 was measured. */
    @JsonProperty("flex")
    FLEX,
    /** Keeps the momentum of internal forces. */
    @JsonProperty("conserving")
    CONSERVING,
    /** In incompressible water: divergence-free SPH. */
    @JsonProperty("dfsph")
    DFSPH
}
