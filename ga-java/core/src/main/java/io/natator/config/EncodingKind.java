package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.encoding.DenseEncoding;
import io.natator.encoding.Encoding;
import io.natator.encoding.SparseEncoding;
import io.natator.encoding.SteeredEncoding;
import io.natator.encoding.WaveEncoding;

/** How genes stand for a gait. */
public enum EncodingKind {
    /** Frequency, every amplitude, every phase but the first. */
    @JsonProperty("dense")
    DENSE,
    /** Frequency, first and last amplitude, phase difference. */
    @JsonProperty("sparse")
    SPARSE,
    /** Frequency, first and last amplitude, waves from head to tail. */
    @JsonProperty("wave")
    WAVE,
    /** The dense genes and an offset to one side. */
    @JsonProperty("dense-steered")
    DENSE_STEERED,
    /** The sparse genes and an offset to one side. */
    @JsonProperty("sparse-steered")
    SPARSE_STEERED;

    /**
     * The encoding of this kind for a creature.
     *
     * @param actuators number of actuators of the creature
     * @throws IllegalArgumentException if there are too few for this kind
     */
    public Encoding forActuators(int actuators) {
        return switch (this) {
            case DENSE -> new DenseEncoding(actuators);
            case SPARSE -> new SparseEncoding(actuators);
            case WAVE -> new WaveEncoding(actuators);
            case DENSE_STEERED -> new SteeredEncoding(new DenseEncoding(actuators));
            case SPARSE_STEERED -> new SteeredEncoding(new SparseEncoding(actuators));
        };
    }

    /**
     * The encoding that the thesis used for a creature (2.7), by the scene's name: sparse for creature 2, else dense. It is a wave in
     * plane flow; scenes whose goals are to one side have an offset.
     */
    public static EncodingKind usualFor(String scene) {
        if (scene.startsWith("goals/")) {
            return SPARSE_STEERED;
        }
        if (scene.matches("plane/[a-z-]+")) {
            return WAVE;
        }
        return scene.matches("[a-z-]+/creature-2(-vacuum)?") ? SPARSE : DENSE;
    }
}
