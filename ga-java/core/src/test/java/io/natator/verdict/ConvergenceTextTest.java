package io.natator.verdict;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.checkpoint.Convergence;
import io.natator.config.Json;
import org.junit.jupiter.api.Test;

class ConvergenceTextTest {

    private static String text(String error) throws JsonProcessingException {
        return ConvergenceText.of(Json.parse("""
                {"gait": {"frequency": 2, "amplitude": [0.1], "phase": [0]}, "bodyLength": 2,
                 "levels": [{"level": "base", "runs": 2, "unstable": 0, "speed": {"mean": 0.5, "error": 0.02}},
                            {"level": "time/2", "runs": 1, "unstable": 1, "change": {"mean": 0.1, "error": %s}}],
                 "estimate": {"speed": 0.6, "error": %s}}""".formatted(error, error), Convergence.class));
    }

    @Test
    void changesAndTheLimitHaveTheirErrors() throws JsonProcessingException {
        assertThat(text("0.04")).isEqualTo(
                "0.300 ± 0.020 body lengths/s at time step and spacing 0, from 10.0 ± 4.0 % at half the time step (1 run unstable)");
    }

    @Test
    void oneRunDoesNotTellItsError() throws JsonProcessingException {
        assertThat(text("null")).isEqualTo(
                "0.300 ± ? body lengths/s at time step and spacing 0, from 10.0 ± ? % at half the time step (1 run unstable)");
    }
}
