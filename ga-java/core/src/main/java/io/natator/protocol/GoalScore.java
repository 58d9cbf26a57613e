package io.natator.protocol;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonInclude;

/**
 * What became of one of a scene's goals.
 *
 * @param measure   what was asked: distance, forward, turn, depth, reach, hold or economy
 * @param weight    of its score among those of the scene's goals
 * @param score     the larger the better
 * @param left      what was left to go at the end of one that is arrived at, in degrees or scene units; else null
 * @param arrivedAt when it was arrived at in seconds, or null
 */
@JsonIgnoreProperties(ignoreUnknown = true)
@JsonInclude(JsonInclude.Include.NON_NULL)
public record GoalScore(String measure, double weight, double score, Double left, Double arrivedAt) {
}
