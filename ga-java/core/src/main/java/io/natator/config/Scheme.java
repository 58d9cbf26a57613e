package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;

/** How the simulator solves a step. */
public enum Scheme {
    /** As NVIDIA Flex 1.2.0 was measured. */
    @JsonProperty("flex")
    FLEX,
    /** Incompressible water, and bodies that move by their own forces alone. */
    @JsonProperty("conserving")
    CONSERVING,
    /** The same bodies in water on a lattice, which has no surface. */
    @JsonProperty("lattice")
    LATTICE
}
