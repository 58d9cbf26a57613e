package io.natator.replay;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.RandomCases;

/** Tables and numbers come back from their codes. */
class TimeCodeProperties {

    @RandomCases(1000)
    void aTableComesBack(RandomCases.Case one) {
        int bytes = one.whole(1, 4);
        int times = one.whole(1, 5);
        int numbers = one.whole(0, 7);
        TimeCode.Expectation[] expectations = TimeCode.Expectation.values();
        TimeCode.Expectation expectation = expectations[one.whole(0, expectations.length - 1)];
        int[][] rows = new int[times][numbers];
        for (int[] row : rows) {
            for (int i = 0; i < numbers; i++) {
                row[i] = one.random().nextInt() & (bytes == 4 ? -1 : (1 << 8 * bytes) - 1);
            }
        }

        byte[] code = TimeCode.encode(rows, bytes, expectation);

        assertThat(code).hasSize(times * numbers * bytes);
        assertThat(TimeCode.decode(code, times, numbers, bytes, expectation)).isDeepEqualTo(rows);
    }

    @RandomCases(1000)
    void aNumberComesBackWithinHalfAStep(RandomCases.Case one) {
        double low = one.number(-10, 10);
        double range = one.number(0, 5);
        double share = one.number(0, 1);
        int bits = one.whole(1, 24);
        Quantiser steps = Quantiser.over(low, low + range, bits);
        double value = low + share * range;

        assertThat(steps.of(value)).isBetween(0, (1 << bits) - 1);
        assertThat(Math.abs(steps.value(steps.of(value)) - value))
                .isLessThanOrEqualTo(steps.step() / 2 * (1 + 1e-9) + 1e-12);
    }
}
