package io.natator.analysis;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class DecimalTest {

    @ParameterizedTest
    @CsvSource({"-0.00004, 4, 0.0000", "-0.0, 2, 0.00", "-0.4, 0, 0", "-0.00005001, 4, -0.0001", "-10, 1, -10.0",
        "1.25, 4, 1.2500"})
    void whatIsRoundedToZeroHasNoSign(double value, int digits, String text) {
        assertThat(Decimal.of(value, digits)).isEqualTo(text);
    }
}
