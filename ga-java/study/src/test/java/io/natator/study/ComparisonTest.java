package io.natator.study;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.List;
import org.junit.jupiter.api.Test;

class ComparisonTest {

    @Test
    void spreadIsThatOfTheDifferenceOfTwoSingleRuns() {
        Variant variant = StudyFixtures.variant("v", "{}", 1.0, 1.6);  // mean 1.3, deviation 0.3 sqrt 2
        Comparison comparison = Comparison.of(variant, Interval.FOUR_SECONDS, List.of(1.6, 2.4, 2.0), List.of());  // 2, 0.4
        double spread = Math.sqrt(0.18 + 0.16);
        assertThat(comparison.difference()).isCloseTo(0.7, within(1e-12));
        assertThat(comparison.spread()).isCloseTo(spread, within(1e-12));
        assertThat(comparison.differenceInSpreads()).isCloseTo(0.7 / spread, within(1e-12));
        assertThat(comparison.standardError()).isCloseTo(Math.sqrt(0.18 / 2 + 0.16 / 3), within(1e-12));
    }

    @Test
    void aSingleRunOfFlexIsTakenToScatterAsOurs() {
        Comparison comparison = Comparison.of(StudyFixtures.variant("v", "{}", 1.0), Interval.FOUR_SECONDS,
                List.of(1.6, 2.4, 2.0), List.of());
        assertThat(comparison.spread()).isCloseTo(0.4 * Math.sqrt(2), within(1e-12));
        assertThat(comparison.standardError()).isCloseTo(0.4 * Math.sqrt(1 + 1.0 / 3), within(1e-12));
    }

    @Test
    void eachIntervalIsComparedWithItsOwnColumn() {
        Variant variant = StudyFixtures.variant("v", "{}", 1.0);
        assertThat(Comparison.of(variant, Interval.TWO_SECONDS, List.of(0.5), List.of()).flex().mean()).isEqualTo(0.5);
        assertThat(Comparison.of(variant, Interval.FOUR_SECONDS, List.of(0.5), List.of()).flex().mean()).isEqualTo(1.0);
    }

    @Test
    void aSingleRunOfOursHasNoSpread() {
        Comparison comparison = Comparison.of(StudyFixtures.variant("v", "{}", 1.0, 2.0), Interval.FOUR_SECONDS,
                List.of(1.0), List.of());
        assertThat(comparison.spread()).isNaN();
        assertThat(ComparisonTable.csv(List.of(comparison))).contains("1.0000,,,-0.50000,,,\n");
    }
}
