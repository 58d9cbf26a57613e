package io.natator.study.thesis;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class SpeedTest {

    @ParameterizedTest
    @CsvSource({"0.0062,0.0004,-0.0006,NaN,2,0.0031 ± 0.0003,± 0.0002", "0.96,0.05,0.01,-0.15,1,0.96 ± 0.15,± 0.05",
        "0.1,0.001,0.03,NaN,1,0.10 ± 0.03,± 0.001", "0.5,0,NaN,NaN,1,0.50 ± 0.00,± 0.00", "0.5,0.1,NaN,NaN,NaN,–,–"})
    void itsErrorIsNotRoundedToNothing(double mean, double scatter, double halfStep, double halfSpacing, double unit, String text,
            String starts) {
        Speed speed = new Speed(mean, scatter, halfStep, halfSpacing);

        assertThat(speed.text(unit)).isEqualTo(text);
        assertThat(speed.scatterText(unit)).isEqualTo(starts);
    }
}
