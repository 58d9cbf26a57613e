package io.natator.study.thesis;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.study.Sample;
import java.util.Arrays;
import java.util.List;
import org.junit.jupiter.api.Test;

class TrendTest {

    private static final Sample USUAL = Sample.of(List.of(0.10, 0.11, 0.09, 0.10));

    private static Sample about(double mean) {
        return Sample.of(List.of(mean, mean + 0.01, mean - 0.01, mean));
    }

    private static Trend trend(double... means) {
        return new Trend(USUAL, Arrays.stream(means).mapToObj(TrendTest::about).toList());
    }

    @Test
    void whatFallsHindersUnlessItRisesOnTheWay() {
        assertThat(trend(0.10, 0.08, 0.03).hinders()).isEqualTo(Claim.Outcome.HOLDS);
        assertThat(trend(0.20, 0.03).hinders()).isEqualTo(Claim.Outcome.OPEN);
        assertThat(trend(0.03, 0.10).hinders()).isEqualTo(Claim.Outcome.FAILS);
        assertThat(trend(0.15).hinders()).isEqualTo(Claim.Outcome.FAILS);
    }

    /** A body that goes backwards as fast moves. */
    @Test
    void goingBackwardsIsNoStandingStill() {
        assertThat(trend(-0.09).stops()).isEqualTo(Claim.Outcome.FAILS);
        assertThat(trend(0.005).stops()).isEqualTo(Claim.Outcome.HOLDS);
    }

    /** Runs that scatter by as much as the speed itself say nothing. */
    @Test
    void noDifferenceIsSaidOnlyWhereOneWouldShow() {
        Sample wild = Sample.of(List.of(0.0, 0.2, 0.05, 0.15));

        assertThat(new Trend(about(0.2), List.of(about(0.2))).makesNoDifference()).isEqualTo(Claim.Outcome.HOLDS);
        assertThat(new Trend(about(0.2), List.of(about(0.14))).makesNoDifference()).isEqualTo(Claim.Outcome.FAILS);
        assertThat(new Trend(wild, List.of(wild)).makesNoDifference()).isEqualTo(Claim.Outcome.OPEN);
        assertThat(new Trend(wild, List.of()).swims()).isTrue();
        assertThat(new Trend(Sample.of(List.of(-0.1, 0.1, 0.02)), List.of()).swims()).isFalse();
    }

    @Test
    void slowingALittleLeavesHalf() {
        assertThat(trend(0.07).slowsALittle()).isEqualTo(Claim.Outcome.HOLDS);
        assertThat(trend(0.03).slowsALittle()).isEqualTo(Claim.Outcome.FAILS);
        assertThat(trend(0.10).slowsALittle()).isEqualTo(Claim.Outcome.FAILS);
    }

    /** Student's t of 3 degrees of freedom is 3.182 at 97.5 %. */
    @Test
    void anErrorBarCoversStartsTimeStepAndSpacing() {
        Sample four = Sample.of(List.of(0.30, 0.32, 0.28, 0.30));
        double deviation = Math.sqrt(0.0008 / 3);

        assertThat(Speed.interval(four)).isCloseTo(3.182 * deviation / 2, within(1e-5));
        assertThat(Speed.of(four, about(0.2), Double.NaN).error()).isCloseTo(0.1, within(1e-9));
        assertThat(Speed.of(four, about(0.3), -0.15).error()).isEqualTo(0.15);
        assertThat(Speed.of(four, Sample.of(List.of()), Double.NaN).error()).isEqualTo(Speed.interval(four));
    }

    @Test
    void severalTestsAgreeOrAreOpen() {
        assertThat(Claim.Outcome.of(List.of(Claim.Outcome.HOLDS, Claim.Outcome.HOLDS))).isEqualTo(Claim.Outcome.HOLDS);
        assertThat(Claim.Outcome.of(List.of(Claim.Outcome.HOLDS, Claim.Outcome.FAILS))).isEqualTo(Claim.Outcome.OPEN);
        assertThat(Claim.Outcome.HOLDS.told()).isEqualTo("✔ holds");
    }
}
