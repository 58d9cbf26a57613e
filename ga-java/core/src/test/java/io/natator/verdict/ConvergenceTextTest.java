package io.natator.verdict;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.checkpoint.Convergence;
import io.natator.config.Json;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class ConvergenceTextTest {

    private static String text(String error) throws JsonProcessingException {
        return text("0.5, \"error\": 0.02", "0.1, \"error\": " + error, "0.55, \"error\": 0.02", error);
    }

    private static String text(String base, String change, String finer, String error) throws JsonProcessingException {
        return ConvergenceText.of(Json
                .parse("""
                        {"gait": {"frequency": 2, "amplitude": [0.1], "phase": [0]}, "bodyLength": 2,
                         "levels": [{"level": "base", "runs": 2, "unstable": 0, "speed": {"mean": %s}},
                                    {"level": "time/2", "runs": 1, "unstable": 1, "speed": {"mean": %s}, "change": {"mean": %s}}],
                         "estimate": {"speed": 0.6, "error": %s}}"""
                        .formatted(base, finer, change, error), Convergence.class));
    }

    @Test
    void changesAndTheLimitHaveTheirErrors() throws JsonProcessingException {
        assertThat(text("0.04"))
                .isEqualTo("not known whether converged: 0.300 ± 0.020 body lengths/s at time step and spacing 0, "
                        + "from 10.0 ± 4.0 % at half the time step (1 run unstable)");
    }

    @Test
    void oneRunDoesNotTellItsError() throws JsonProcessingException {
        assertThat(text("null"))
                .isEqualTo("not known whether converged: 0.300 ± ? body lengths/s at time step and spacing 0, "
                        + "from 10.0 ± ? % at half the time step (1 run unstable)");
    }

    /** As many standard errors on either side as a change is sure to have. */
    @ParameterizedTest
    @CsvSource({"0.05, 0.02, converged to within 10 %", "-0.05, 0.02, converged to within 10 %",
            "0.05, 0.03, not known whether converged",
            "-0.1, 0, converged to within 10 %", "0.3, 0.09, not converged", "-0.3, 0.09, not converged",
            "-0.3, 0.11, not known whether converged",
            "0, 23.72, not known whether converged"})
    void whatIsSaidFollowsFromTheErrors(double change, double error, String said) throws JsonProcessingException {
        assertThat(text("0.5, \"error\": 0.02", change + ", \"error\": " + error, "0.5, \"error\": 0.02", "0.04"))
                .startsWith(said + ": ");
    }

    /** A share of it would be any number, with any error. */
    @ParameterizedTest
    @CsvSource({"0.003, 0.01", "-0.019, 0.01", "0, 0"})
    void aSpeedThatMayBeNoneHasNoShares(double base, double error) throws JsonProcessingException {
        assertThat(text(base + ", \"error\": " + error, "-6.11, \"error\": 23.72", "0.005, \"error\": 0.02", "0.024"))
                .startsWith(
                        "no speed that could be told from none: 0.300 ± 0.012 body lengths/s at time step and spacing 0, from ")
                .endsWith(" body lengths/s more at half the time step (1 run unstable)").doesNotContain("%");
    }
}
