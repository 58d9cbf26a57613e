package io.natator.stream;

import com.fasterxml.jackson.annotation.JsonProperty;
import java.util.Locale;

/** What a frame may hold of every particle, in the order in which it does. */
public enum StreamField {
    /** Place, length. */
    @JsonProperty("position")
    POSITION(3),
    /** Velocity, length/s. */
    @JsonProperty("velocity")
    VELOCITY(3),
    /** Density in rest densities; 0 for solids. */
    @JsonProperty("density")
    DENSITY(1),
    /** Force of the water over the frame, mass length/s²; not in scheme flex. */
    @JsonProperty("force")
    FORCE(3);

    private final int components;

    StreamField(int components) {
        this.components = components;
    }

    /** Numbers per particle. */
    public int components() {
        return components;
    }

    /** Its name in the protocol and on the command line. */
    public String text() {
        return name().toLowerCase(Locale.ROOT);
    }
}
