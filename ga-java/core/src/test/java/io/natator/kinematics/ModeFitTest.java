package io.natator.kinematics;

import static io.natator.kinematics.SyntheticSwimmer.FREQUENCY;
import static io.natator.kinematics.SyntheticSwimmer.LENGTH;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.Comparator;
import java.util.List;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

class ModeFitTest {

    private static Swimming swimming(SyntheticSwimmer.Wave wave) {
        return new Swimming(SyntheticSwimmer.path(wave, 0, 0));
    }

    /** The wave itself, not turned to its line of best fit. */
    private static LateralMotion unturned(SyntheticSwimmer.Wave wave) {
        double[] times = IntStream.range(0, 48).mapToDouble(frame -> frame / 60.0).toArray();
        return new LateralMotion() {
            @Override
            public double[] times() {
                return times;
            }

            @Override
            public double length() {
                return LENGTH;
            }

            @Override
            public double measuredLength() {
                return 0.9 * LENGTH;
            }

            @Override
            public double lateral(int frame, double x) {
                return wave.at(x, times[frame]);
            }
        };
    }

    /** z_s(x, t + β) is the real fish α times too small. */
    @ParameterizedTest
    @EnumSource(FishMode.class)
    void findsEachModeInItself(FishMode mode) {
        LateralMotion fish = unturned((x, t) -> mode.lateral(x, t - 0.13, LENGTH, FREQUENCY) / 1.6);

        List<ModeFit> fits = ModeFit.all(fish, FREQUENCY);

        ModeFit own = fits.get(mode.ordinal());
        assertThat(fits.stream().min(Comparator.comparingDouble(ModeFit::error))).hasValue(own);
        assertThat(own.mode()).isEqualTo(mode);
        assertThat(own.error()).isCloseTo(0, within(1e-12));
        assertThat(own.alpha()).isCloseTo(1.6, within(1e-9));
        assertThat(own.beta()).isCloseTo(0.13, within(1e-9));
    }

    @ParameterizedTest
    @EnumSource(FishMode.class)
    void aFishIsLikeItselfAndNothingIsLikeNone(FishMode mode) {
        LateralMotion fish = unturned((x, t) -> mode.lateral(x, t, LENGTH, FREQUENCY) / 3);
        LateralMotion tenfold = unturned((x, t) -> 20 * mode.lateral(x, t, LENGTH, FREQUENCY));
        LateralMotion still = unturned((x, t) -> 0);

        assertThat(ModeFit.nearest(ModeFit.all(fish, FREQUENCY))).map(ModeFit::mode).hasValue(mode);
        assertThat(ModeFit.of(tenfold, mode, FREQUENCY).relative()).isLessThan(0.01);
        assertThat(ModeFit.of(tenfold, mode, FREQUENCY).resembles()).as("its motion is twenty times a fish's").isFalse();
        assertThat(ModeFit.of(still, mode, FREQUENCY).relative()).isCloseTo(1, within(0.02));
        assertThat(ModeFit.of(still, mode, FREQUENCY).none()).isCloseTo(Math.sqrt(0.9) / 3, within(0.01));
        assertThat(ModeFit.nearest(ModeFit.all(still, FREQUENCY))).isEmpty();
    }

    /** The definition, summed up as it is written: least of all α and β of the grid. */
    @Test
    void isTheLeastOfTheDefinition() {
        LateralMotion swimming = unturned((x, t) -> 0.05 * x * Math.sin(6 * x - 2 * Math.PI * FREQUENCY * t) + 0.01 * x);
        FishMode mode = FishMode.CARANGIFORM;

        ModeFit fit = ModeFit.of(swimming, mode, FREQUENCY);

        assertThat(fit.alpha()).isBetween(0.02, 0.5);
        assertThat(error(swimming, mode, fit.alpha(), fit.beta())).isCloseTo(fit.error(), within(1e-12));
        for (double beta = 0; beta < 1 / FREQUENCY; beta += 0.05) {
            for (double alpha = 0; alpha < 0.5; alpha += 0.1) {
                assertThat(error(swimming, mode, alpha, beta)).isGreaterThanOrEqualTo(fit.error());
            }
        }
        for (double step : new double[] {-0.01, 0.01}) {
            assertThat(error(swimming, mode, fit.alpha() + step, fit.beta())).isGreaterThan(fit.error());
            assertThat(error(swimming, mode, fit.alpha(), fit.beta() + step)).isGreaterThan(fit.error());
        }
    }

    /** z_r at t − β against z_s at t. */
    private static double error(LateralMotion swimming, FishMode mode, double alpha, double beta) {
        double[] times = swimming.times();
        double sum = 0;
        for (int frame = 0; frame < times.length; frame++) {
            for (int i = 0; i <= 1000; i++) {
                double x = swimming.measuredLength() * i / 1000;
                double real = mode.lateral(x, times[frame] - beta, LENGTH, FREQUENCY);
                double difference = (real - alpha * swimming.lateral(frame, x)) / mode.amplitude(x, LENGTH, FREQUENCY);
                sum += Math.sqrt(x / LENGTH) * difference * difference;
            }
        }
        return sum / (1001 * times.length);
    }

    /** What turning a fish to its line of best fit costs. */
    @Test
    void aSpineOfAnEelIsAnEelsAfterTurning() {
        Swimming eel = swimming((x, t) -> FishMode.ANGUILLIFORM.lateral(x, t, LENGTH, FREQUENCY));

        List<ModeFit> fits = ModeFit.all(eel, FREQUENCY);

        assertThat(fits.get(0).error()).isLessThan(0.04);
        assertThat(fits.get(1).error()).isGreaterThan(2 * fits.get(0).error());
        assertThat(fits.get(2).error()).isGreaterThan(2 * fits.get(0).error());
    }

    /** ∫√u du · mean of sin² = 2/3 · 1/2. */
    @ParameterizedTest
    @EnumSource(FishMode.class)
    void aBodyThatDoesNotBendHasAThird(FishMode mode) {
        ModeFit fit = ModeFit.of(swimming((x, t) -> 0), mode, FREQUENCY);

        assertThat(fit.error()).isCloseTo(1.0 / 3, within(2e-3));
        assertThat(fit.alpha()).isZero();
    }

    /** A wave that runs towards the head is no fish's. */
    @Test
    void aWaveThatRunsForwardsFitsBadly() {
        SyntheticSwimmer.Wave backwards = (x, t) -> FishMode.ANGUILLIFORM.lateral(x, -t, LENGTH, FREQUENCY);

        assertThat(ModeFit.of(swimming(backwards), FishMode.ANGUILLIFORM, FREQUENCY).error()).isGreaterThan(0.25);
    }

    @Test
    void headingAndTravelDoNotMatter() {
        SyntheticSwimmer.Wave wave = (x, t) -> FishMode.ANGUILLIFORM.lateral(x, t, LENGTH, FREQUENCY);
        ModeFit straight = ModeFit.of(swimming(wave), FishMode.ANGUILLIFORM, FREQUENCY);

        for (double heading : new double[] {0.5, -1.3, 3}) {
            Swimming turned = new Swimming(SyntheticSwimmer.path(wave, heading, 0.4));
            ModeFit fit = ModeFit.of(turned, FishMode.ANGUILLIFORM, FREQUENCY);
            assertThat(fit.error()).isCloseTo(straight.error(), within(1e-9));
            assertThat(fit.beta()).isEqualTo(straight.beta());
        }
    }

    /** Twice as large a swimmer of the same motion has the same e and half the α. */
    @Test
    void sizeDoesNotMatterButForAlpha() {
        SyntheticSwimmer.Wave wave = (x, t) -> 0.1 * FishMode.ANGUILLIFORM.lateral(x, t, LENGTH, FREQUENCY);
        SyntheticSwimmer.Wave twice = (x, t) -> 2 * wave.at(x, t);

        ModeFit one = ModeFit.of(swimming(wave), FishMode.ANGUILLIFORM, FREQUENCY);
        ModeFit two = ModeFit.of(swimming(twice), FishMode.ANGUILLIFORM, FREQUENCY);

        assertThat(two.error()).isCloseTo(one.error(), within(2e-3));
        assertThat(two.alpha()).isCloseTo(one.alpha() / 2, within(0.1));
    }
}
