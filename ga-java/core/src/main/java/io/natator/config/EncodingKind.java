package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.encoding.DenseEncoding;
import io.natator.encoding.Encoding;
import io.natator.encoding.SparseEncoding;

/** How genes stand for a gait. */
public enum EncodingKind {
    /** Frequency, every amplitude, every phase but the first. */
    @JsonProperty("dense")
    DENSE,
    /** Frequency, first and last amplitude, phase difference. */
    @JsonProperty("sparse")
    SPARSE;

    /**
     * The encoding of this kind for a creature.
     *
     * @param actuators number of actuators of the creature
     * @throws IllegalArgumentException if there are too few for this kind
     */
    public Encoding forActuators(int actuators) {
        return this == DENSE ? new DenseEncoding(actuators) : new SparseEncoding(actuators);
    }

    /** The encoding that the thesis used for a creature (2.7), by the scene's name: sparse for creature 2, else dense. */
    public static EncodingKind usualFor(String scene) {
        return scene.matches("[a-z-]+/creature-2(-vacuum)?") ? SPARSE : DENSE;
    }
}
