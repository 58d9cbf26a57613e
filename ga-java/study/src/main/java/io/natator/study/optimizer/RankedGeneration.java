package io.natator.study.optimizer;

import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.evolution.Individual;
import io.natator.study.statistics.RankCorrelation;
import java.util.List;

/**
 * How well a run's last generation was ranked; a line of {@code SCENE-ranks.jsonl}.
 *
 * @param optimizer label of the variant
 * @param seed      of the run
 * @param starts    fresh starts of each gait
 * @param gaits     different ones in that generation
 * @param spearman  correlation of the ranks that they had with those by the fresh starts; null where there is none
 */
record RankedGeneration(@JsonProperty(required = true) String optimizer, @JsonProperty(required = true) long seed,
        @JsonProperty(required = true) int starts, int gaits, Double spearman) {

    /** Of individuals and what each is worth by fresh starts. */
    static RankedGeneration of(OptimizerRun run, int starts, List<Individual> individuals, List<Double> again) {
        double correlation = RankCorrelation.of(individuals.stream().mapToDouble(Individual::score).toArray(),
                again.stream().mapToDouble(Double::doubleValue).toArray());
        return new RankedGeneration(run.variant().label(), run.settings().seed(), starts, individuals.size(),
                Double.isNaN(correlation) ? null : correlation);
    }
}
