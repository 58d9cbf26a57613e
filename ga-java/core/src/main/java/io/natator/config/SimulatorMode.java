package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;

/**
 * How evaluations reach the native program. A request has the same result in every mode. The command line's default is
 * {@link #PROCESS}, as in the thesis; that of {@link ExecutionSettings#of} is {@link #RESIDENT}, which is faster.
 */
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
