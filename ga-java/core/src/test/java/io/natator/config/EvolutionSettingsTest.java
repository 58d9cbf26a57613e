package io.natator.config;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.base.InvalidInputException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class EvolutionSettingsTest {

    private static EvolutionSettings settings(int population, int generations, double deviation, Double duration) {
        return EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2).withSize(population, generations)
                .withOptimizer(OptimizerKind.JGAP, OperatorSet.CORRECTED, deviation)
                .withScene(Scheme.FLEX, duration, null);
    }

    @ParameterizedTest
    @CsvSource({"150, 30", "24, 5", "6, 1", "2, 0"})
    void elitesAreAFifthOfThePopulation(int population, int elites) {
        assertThat(settings(population, 1, 0.05, null).search().elites()).isEqualTo(elites);
    }

    /** Of runs that were begun before settings were three records, and for programs that read them. */
    @Test
    void filesHaveAllKeysSideBySideInTheirOldOrder() throws JsonProcessingException {
        String file = "{\"scene\":\"thesis/creature-1\",\"encoding\":\"dense\",\"actuators\":2,\"optimizer\":\"jgap\",\"population\":24,"
                + "\"generations\":8,\"evaluations\":100,\"seed\":1,\"operators\":\"stock\",\"gaussianDeviation\":0.05,\"fitness\":\"net\","
                + "\"vacuumCheck\":true,\"backend\":\"cuda\",\"scheme\":\"flex\",\"duration\":2.5,\"overrides\":{\"solver\":{\"substeps\":4}},"
                + "\"starts\":4,\"judge\":\"mean\"}";

        assertThat(Json.line(Json.parse(file, EvolutionSettings.class))).isEqualTo(file);
    }

    @Test
    void whatIsOutOfRangeIsNamed() {
        assertThatThrownBy(() -> settings(1, 1, 0.05, null)).isInstanceOf(InvalidInputException.class)
                .hasMessage("population is 1; expected a whole number from 2 to 100000");
        assertThatThrownBy(() -> settings(2, -1, 0.05, null)).hasMessageStartingWith("generations is -1");
        assertThatThrownBy(() -> settings(2, 1, Double.NaN, null)).hasMessageStartingWith("gaussian-deviation is NaN");
        assertThatThrownBy(() -> settings(2, 1, 0.05, 0.0)).hasMessageStartingWith("duration is 0.0");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {"{\"scene\":\"a\"}|actuators",
            "{\"scene\":\"a\",\"encoding\":\"dense\",\"actuators\":2,\"population\":9,\"generations\":1,\"seed\":1,\"gaussianDeviation\":0.1,"
                    + "\"sed\":2}|sed",
            "{\"scene\":\"a\",\"scene\":\"b\"}|scene", "{\"scene\":\"a\"|ends too early", "{\"population\":2.5}|2.5"})
    void damagedFilesSayWhereAndWhat(String json, String what) {
        assertThatThrownBy(() -> Json.parse(json, EvolutionSettings.class))
                .isInstanceOfSatisfying(JsonProcessingException.class,
                        e -> assertThat(Json.reason(e)).contains(what).doesNotContain("\n"));
    }
}
