package io.natator.study;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.List;
import org.junit.jupiter.api.Test;

class SampleTest {

    @Test
    void deviationHasCountMinusOneInTheDenominator() {
        Sample sample = Sample.of(List.of(2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0));
        assertThat(sample.count()).isEqualTo(8);
        assertThat(sample.mean()).isEqualTo(5.0);
        assertThat(sample.standardDeviation()).isCloseTo(Math.sqrt(32.0 / 7), within(1e-15));
    }

    @Test
    void oneValueHasNoSpread() {
        Sample sample = Sample.of(List.of(0.25));
        assertThat(sample.mean()).isEqualTo(0.25);
        assertThat(sample.hasSpread()).isFalse();
        assertThat(sample.standardDeviation()).isNaN();
    }

    @Test
    void noValueHasNoMean() {
        assertThat(Sample.of(List.of()).mean()).isNaN();
    }
}
