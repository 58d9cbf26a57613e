package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;

/** How evaluations reach the native program. The same request gives the same result in all of them. */
public enum SimulatorMode {
    /** A process for each evaluation, as in the thesis. */
    @JsonProperty("process")
    PROCESS,
    /** Processes kept alive, each with one evaluation at a time. */
    @JsonProperty("resident")
    RESIDENT,
    /** One process that is given all evaluations of a generation together, for a GPU. */
    @JsonProperty("batch")
    BATCH,
    /** The executors of an Apache Spark cluster; only in the program for it. */
    @JsonProperty("spark")
    SPARK
}
