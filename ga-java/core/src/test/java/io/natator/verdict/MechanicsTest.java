package io.natator.verdict;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.Json;
import io.natator.simulator.SimulationResult;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class MechanicsTest {

    private static SimulationResult result(String more) throws JsonProcessingException {
        return Json.parse("{\"id\":1,\"status\":\"ok\",\"distance\":0.5,\"stopped\":\"completed\",\"simulated\":4,"
                + "\"frames\":240,\"scheme\":\"conserving\",\"precision\":\"float\",\"hash\":\"0123456789abcdef\"" + more + "}",
                SimulationResult.class);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
        ",\"swimming\":{\"tailAmplitude\":0.25,\"strouhal\":0.3125,\"reynolds\":131.4,\"swimmingNumber\":409.6},\"work\":0.75"
            + "|Re 131, St 0.313, swimming number 410, work 0.75",
        ",\"swimming\":{\"tailAmplitude\":0.25,\"reynolds\":0,\"swimmingNumber\":123456},\"work\":-0.00012345"
            + "|Re 0, swimming number 123000, work -0.000123",
        ",\"swimming\":{\"tailAmplitude\":0.25,\"strouhal\":0.3,\"of a later version\":1}|St 0.3",
        ",\"work\":2e-7|work 0.0000002"})
    void whatAResultTellsIsSaidInWords(String more, String text) throws JsonProcessingException {
        assertThat(Mechanics.of(result(more))).isEqualTo(text);
    }

    @Test
    void withoutNumbersThereIsNothingToSay() throws JsonProcessingException {
        assertThat(Mechanics.of(result(""))).isNull();
        assertThat(Mechanics.of(SimulationResult.failed(1, "no answer"))).isNull();
    }
}
