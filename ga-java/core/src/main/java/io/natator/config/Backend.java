package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;
import java.util.Locale;

/** What the simulator computes on. Each has bits of its own, so a run keeps to one. */
public enum Backend {
    /** The processor. */
    @JsonProperty("cpu")
    CPU,
    /** An NVIDIA GPU. */
    @JsonProperty("cuda")
    CUDA,
    /** A GPU where there is one that can, else the processor. */
    @JsonProperty("auto")
    AUTO;

    /** The name that the simulator knows it by. */
    public String argument() {
        return name().toLowerCase(Locale.ROOT);
    }
}
