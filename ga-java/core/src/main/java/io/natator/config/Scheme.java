package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;
import java.util.Arrays;

/** How the simulator solves a step. */
public enum Scheme {
    /** Position-based dynamics as NVIDIA Flex 1.2.0 was measured to do it. */
    @JsonProperty("flex")
    FLEX,
    /** Incompressible water, and bodies that move by their own forces alone. */
    @JsonProperty("conserving")
    CONSERVING,
    /** The bodies of {@code conserving} in water on a lattice, which has no surface. */
    @JsonProperty("lattice")
    LATTICE;

    /** The scheme that a result names; null without one. */
    public static Scheme of(String name) {
        return Arrays.stream(values()).filter(one -> Json.name(one).equals(name)).findFirst().orElse(null);
    }

    /** Whether bodies move by their own forces alone, so that a body that advances in water swims. */
    public boolean keepsMomentum() {
        return this != FLEX;
    }
}
