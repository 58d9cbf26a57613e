package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;

/** Which genetic operators to use. */
public enum OperatorSet {
    /** Operators that do what the thesis says (2.6), with JGAP's mistakes mended. */
    @JsonProperty("corrected")
    CORRECTED,
    /** JGAP 3.4.4 as shipped, which the thesis ran. */
    @JsonProperty("stock")
    STOCK
}
