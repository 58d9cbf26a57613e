package io.natator.study.thesis;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.List;
import org.junit.jupiter.api.Test;

/** When evolutions from several seeds count as having found the same speed. */
class AgreementTest {

    @Test
    void seedsAgreeWithinTheLargerErrorOfTheFastestAndTheSlowest() {
        Agreement within = new Agreement(List.of(speed(0.30, 0.01), speed(0.35, 0.06), speed(0.32, 0.01)));
        assertThat(within.apart()).isCloseTo(0.05, within(1e-12));
        assertThat(within.holds()).isTrue();
    }

    @Test
    void anErrorOfNeitherTheFastestNorTheSlowestExcusesNothing() {
        assertThat(new Agreement(List.of(speed(0.30, 0.01), speed(0.32, 0.5), speed(0.35, 0.02))).holds()).isFalse();
    }

    @Test
    void oppositeSignsAreApart() {
        Agreement opposite = new Agreement(List.of(speed(-0.2, 0.1), speed(0.2, 0.1)));
        assertThat(opposite.apart()).isCloseTo(0.4, within(1e-12));
        assertThat(opposite.holds()).isFalse();
    }

    private static Speed speed(double mean, double scatter) {
        return new Speed(mean, scatter, Double.NaN, Double.NaN);
    }
}
