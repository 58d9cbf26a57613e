package io.natator.config;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.base.InvalidInputException;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class WeightedObjectiveTest {

    @Test
    void namesAndWeights() {
        assertThat(WeightedObjective.parse("distance,work")).isEqualTo(List.of(
                new WeightedObjective(Objective.DISTANCE, null), new WeightedObjective(Objective.WORK, null)));
        assertThat(WeightedObjective.parse("forward=1,straight=0.2")).isEqualTo(List.of(
                new WeightedObjective(Objective.FORWARD, 1.0), new WeightedObjective(Objective.STRAIGHT, 0.2)));
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {"speed|has 'speed'; expected some of", "distance=0|expected a weight above 0",
            "distance=x|expected a weight above 0", "distance=|expected a weight above 0",
            "distance=1=2|expected a weight",
            "distance=Infinity|expected a weight above 0", "work,work|has work twice",
            "work,|has ''; expected some of"})
    void othersAreRefused(String text, String message) {
        assertThatThrownBy(() -> WeightedObjective.parse(text)).isInstanceOf(InvalidInputException.class)
                .hasMessageStartingWith("--objectives ").hasMessageContaining(message);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "JGAP|distance,work|optimizer jgap has one objective, not distance and work; expected a weight for each",
            "CMA_ES|distance,work|optimizer cma-es has one objective",
            "JGAP|distance=1,work|of which 1 have weights; expected all or none",
            "NSGA2|distance|optimizer nsga2 is for several objectives without weights, not distance",
            "NSGA2|distance=1,work=1|optimizer nsga2 is for several objectives without weights"})
    void anOptimizerHasOneObjectiveOrSeveral(OptimizerKind optimizer, String objectives, String message) {
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2);
        assertThatThrownBy(() -> settings.withObjectives(optimizer, WeightedObjective.parse(objectives)))
                .isInstanceOf(InvalidInputException.class).hasMessageContaining(message);
        assertThatThrownBy(() -> settings.withObjectives(OptimizerKind.NSGA2, null)).hasMessageContaining("not none");
        assertThatThrownBy(() -> settings.withStarts(4, Aggregate.LOWER_QUARTILE)
                .withObjectives(OptimizerKind.NSGA2, WeightedObjective.parse("distance,work")))
                .hasMessage("optimizer nsga2 judges by means; expected --judge mean");
        assertThatThrownBy(() -> settings.withFitness(FitnessKind.NET, false)
                .withObjectives(OptimizerKind.JGAP, WeightedObjective.parse("forward")))
                .hasMessageContaining("--fitness and --objectives exclude each other");
    }
}
