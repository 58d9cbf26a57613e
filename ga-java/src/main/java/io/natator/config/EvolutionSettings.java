package io.natator.config;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.JsonNode;

/**
 * All that determines the outcome of an evolution: the same settings and simulator give the same run. Written to
 * {@code config.json}; how it is executed (workers, time limit, paths) is not part of it.
 *
 * @param scene             name or path of the scene
 * @param encoding          how genes stand for a gait
 * @param actuators         number of actuators of the scene's creature
 * @param population        chromosomes at the start and selected in each generation, at least 2 (thesis: 150)
 * @param generations       generations bred after the random one, at least 0 (thesis: 100)
 * @param seed              of all random choices
 * @param operators         which genetic operators to use
 * @param gaussianDeviation deviation of the Gaussian mutation as a share of the gene's range, above 0; JGAP's own: 0.05
 * @param scheme            scheme to ask the simulator for, or null for the scene's own
 * @param duration          simulated time in seconds, above 0, or null for the scene's own
 * @param overrides         JSON Merge Patch on the scene, or null
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record EvolutionSettings(String scene, EncodingKind encoding, int actuators, int population, int generations,
        long seed, OperatorSet operators, double gaussianDeviation, Scheme scheme, Double duration,
        JsonNode overrides) {

    /** Elites of 150 selected chromosomes (thesis 2.6). */
    private static final double ELITE_SHARE = 30.0 / 150.0;

    /**
     * Checks the ranges.
     *
     * @throws InvalidInputException naming the setting that is out of range
     */
    public EvolutionSettings {
        require(population >= 2, "population", population, "a whole number from 2");
        require(generations >= 0, "generations", generations, "a whole number from 0");
        require(gaussianDeviation > 0 && gaussianDeviation <= 1, "gaussian-deviation", gaussianDeviation,
                "a number above 0 and up to 1");
        require(duration == null || duration > 0 && duration < Double.POSITIVE_INFINITY, "duration", duration,
                "a number of seconds above 0");
    }

    private static void require(boolean valid, String name, Object value, String expected) {
        if (!valid) {
            throw new InvalidInputException(name + " is " + value + "; expected " + expected);
        }
    }

    /** How many of the selected are the best; 30 of 150 as in the thesis, the same share of other populations. */
    public int elites() {
        return (int) Math.round(ELITE_SHARE * population);
    }
}
