package io.natator.config;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.JsonNode;
import io.soabase.recordbuilder.core.RecordBuilder;
import java.util.List;

/** {@link EvolutionSettings} as {@code config.json} has them: all keys side by side, in this order. */
@JsonInclude(JsonInclude.Include.NON_NULL)
@RecordBuilder
record SettingsFile(String scene, EncodingKind encoding, int actuators, OptimizerKind optimizer,
        int population, int generations, Long evaluations, long seed, OperatorSet operators, double gaussianDeviation,
        FitnessKind fitness, Boolean vacuumCheck, Backend backend, Scheme scheme, Double duration,
        JsonNode overrides, Integer starts, Aggregate judge, List<WeightedObjective> objectives, BodyEvolution evolve) {

    static SettingsFile of(EvolutionSettings settings) {
        return SettingsFileBuilder.builder().scene(settings.problem().scene()).encoding(settings.problem().encoding())
                .actuators(settings.problem().actuators()).optimizer(settings.search().optimizer())
                .population(settings.search().population()).generations(settings.budget().generations())
                .evaluations(settings.budget().evaluations()).seed(settings.search().seed())
                .operators(settings.search().operators())
                .gaussianDeviation(settings.search().gaussianDeviation()).fitness(settings.problem().fitness())
                .vacuumCheck(settings.problem().vacuumCheck()).backend(settings.budget().backend())
                .scheme(settings.problem().scheme())
                .duration(settings.problem().duration()).overrides(settings.problem().overrides())
                .starts(settings.search().starts())
                .judge(settings.search().judge()).objectives(settings.problem().objectives())
                .evolve(settings.problem().evolve()).build();
    }

    EvolutionSettings settings() {
        return new EvolutionSettings(
                new Problem(scene, encoding, actuators, scheme, duration, overrides, fitness, vacuumCheck, objectives,
                        evolve),
                new Search(optimizer, population, seed, operators, gaussianDeviation, starts, judge),
                new Budget(generations, evaluations, backend));
    }
}
