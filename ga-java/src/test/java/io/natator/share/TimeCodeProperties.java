package io.natator.share;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.Random;
import net.jqwik.api.EdgeCasesMode;
import net.jqwik.api.ForAll;
import net.jqwik.api.Property;
import net.jqwik.api.constraints.DoubleRange;
import net.jqwik.api.constraints.IntRange;

/** Tables and numbers come back from their codes. */
class TimeCodeProperties {

    @Property(edgeCases = EdgeCasesMode.NONE)
    void aTableComesBack(@ForAll @IntRange(min = 1, max = 4) int bytes, @ForAll @IntRange(min = 1, max = 5) int times,
            @ForAll @IntRange(min = 0, max = 7) int numbers, @ForAll TimeCode.Expectation expectation, @ForAll long seed) {
        Random random = new Random(seed);
        int[][] rows = new int[times][numbers];
        for (int[] row : rows) {
            for (int i = 0; i < numbers; i++) {
                row[i] = random.nextInt() & (bytes == 4 ? -1 : (1 << 8 * bytes) - 1);
            }
        }

        byte[] code = TimeCode.encode(rows, bytes, expectation);

        assertThat(code).hasSize(times * numbers * bytes);
        assertThat(TimeCode.decode(code, times, numbers, bytes, expectation)).isDeepEqualTo(rows);
    }

    @Property
    void aNumberComesBackWithinHalfAStep(@ForAll @DoubleRange(min = -10, max = 10) double low,
            @ForAll @DoubleRange(min = 0, max = 5) double range, @ForAll @DoubleRange(min = 0, max = 1) double share,
            @ForAll @IntRange(min = 1, max = 24) int bits) {
        Quantiser steps = Quantiser.over(low, low + range, bits);
        double value = low + share * range;

        assertThat(steps.of(value)).isBetween(0, (1 << bits) - 1);
        assertThat(Math.abs(steps.value(steps.of(value)) - value)).isLessThanOrEqualTo(steps.step() / 2 * (1 + 1e-9) + 1e-12);
    }
}
