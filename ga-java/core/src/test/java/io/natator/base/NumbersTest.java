package io.natator.base;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

class NumbersTest {

    @ParameterizedTest
    @CsvSource({"-0.00004,4,0.0000", "-0.00006,4,-0.0001", "-0.0,4,0.0000", "-0.4,0,0", "-0.6,0,-1", "1.23456,3,1.235",
            "NaN,2,NaN", "-10.001,2,-10.00"})
    void whatRoundsToNothingHasNoSign(double value, int decimals, String text) {
        assertThat(Numbers.fixed(value, decimals)).isEqualTo(text);
    }

    @ParameterizedTest
    @CsvSource({"-0.0046,0.0003,3,-0.0046 ± 0.0003", "0.1,0.01,2,0.10 ± 0.01", "0.00041,0.00003,3,0.00041 ± 0.00003",
            "0.5,0,2,0.50 ± 0.00",
            "0.1,1e-9,3,0.100 ± 0.000", "0.1,0.005,2,0.10 ± 0.01", "-0.00002,0.004,2,0.000 ± 0.004",
            "1,NaN,2,1.00 ± NaN"})
    void anErrorIsNotRoundedToNothing(double value, double error, int decimals, String text) {
        assertThat(Numbers.withError(value, error, decimals)).isEqualTo(text);
    }

    @ParameterizedTest
    @CsvSource({"2,2", "+2.,2", "-.5,-0.5", "1.5e-3,0.0015", "007,7"})
    void whatIsDecimalIsRead(String text, double value) {
        assertThat(Numbers.parse(text)).isEqualTo(value);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {"0x2", "0x1p3", "1f", "1d", "1D", "NaN", "Infinity", "-inf", "", ".", "e3", "1 000", "1e", "٣"})
    void whatJavaAloneTakesForANumberIsNone(String text) {
        assertThatThrownBy(() -> Numbers.parse(text)).isInstanceOf(NumberFormatException.class);
    }

    /** An efficiency, distance by work, is far below a ten-thousandth. */
    @ParameterizedTest
    @CsvSource({"0.81234,0.8123", "-5600.5,-5600.5000", "0,0.0000", "-0.0,0.0000", "0.001,0.0010",
            "0.00099949,0.000999",
            "1.3199e-5,0.0000132", "-4.9951e-6,-0.00000500"})
    void aSmallWorthKeepsItsDigits(double value, String text) {
        assertThat(Numbers.worth(value)).isEqualTo(text);
    }

    @ParameterizedTest
    @CsvSource({"0,0 gaits", "1,1 gait", "2,2 gaits"})
    void oneIsNotSeveral(long count, String text) {
        assertThat(Numbers.count(count, "gait")).isEqualTo(text);
    }
}
