package io.natator.kinematics;

import com.fasterxml.jackson.annotation.JsonInclude;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Optional;

/**
 * How far a swimmer's motion is from that of real fish of one mode (thesis eq. 2.14 to 2.16):
 * e = mean over t and x of √(x/L) ((z_r(x, t) − α z_s(x, t + β)) / a_r(x))², least over α and β by steps of 0.01.
 *
 * <p>α scales the simulated spine. As printed in the thesis it scales the real one, which gives e of 39 to 84 for
 * creature 1, where the thesis has 0.15 to 0.20; its values of at most 1/3, which is what a spine that does not move has,
 * come out this way.
 *
 * <p>A real fish of the formula would not have e = 0: its spine does not lie about its line of best fit, and turning it
 * there gives an anguilliform one an e of up to 0.04, and more to the others. So it is in the thesis.
 *
 * @param mode  the real fish
 * @param error e; 0 for the same motion, {@code none} for one that has nothing of it
 * @param alpha α ≥ 0, without unit
 * @param beta  β in seconds, within one beat
 * @param none  e of a spine that does not move, over the same places and times: √(x_l/L)/3 on average over a beat; null in old
 *              files, where it may be taken as 1/3
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record ModeFit(FishMode mode, double error, double alpha, double beta, Double none) {

    /** From this share of {@code none} on a motion is none of the fish's. */
    private static final double UNLIKE = 0.8;
    /** What has to be made smaller than this to fit is none of the fish's either: it fits best by hardly moving. */
    private static final double LEAST_ALPHA = 0.1;

    /** Places along the spine (thesis 2.8). */
    static final int PLACES = 1001;
    private static final double STEP = 0.01;

    /** The best fit to each mode, in the order of the modes. */
    public static List<ModeFit> all(LateralMotion swimming, double frequency) {
        return Arrays.stream(FishMode.values()).map(mode -> of(swimming, mode, frequency)).toList();
    }

    /**
     * The best fit to a mode.
     *
     * @param frequency of the beat, in 1/s, above 0
     */
    public static ModeFit of(LateralMotion swimming, FishMode mode, double frequency) {
        double[] times = swimming.times();
        double[] places = places(swimming.measuredLength());
        double length = swimming.length();
        double[] amplitude = Arrays.stream(places).map(x -> mode.amplitude(x, length, frequency)).toArray();
        double[] weight = new double[places.length];
        for (int i = 0; i < places.length; i++) {
            weight[i] = Math.sqrt(places[i] / length) / (amplitude[i] * amplitude[i]);
        }
        // With z_r = a (sin(k x − ω t) cos(ω β) + cos(k x − ω t) sin(ω β)), the real spine at t − β, all sums over t and
        // x are taken once: e(α, β) = A(β) − 2 α B(β) + α² C.
        Sums sums = new Sums();
        double quarter = 0.25 / frequency;
        for (int frame = 0; frame < times.length; frame++) {
            for (int i = 0; i < places.length; i++) {
                double sine = mode.lateral(places[i], times[frame], length, frequency);
                double cosine = mode.lateral(places[i], times[frame] - quarter, length, frequency);
                sums.add(weight[i], sine, cosine, swimming.lateral(frame, places[i]));
            }
        }
        return least(mode, sums, frequency);
    }

    /** The fish that the motion is nearest to, of those that it is like at all; empty if it is like none. */
    public static Optional<ModeFit> nearest(List<ModeFit> fits) {
        return fits.stream().filter(ModeFit::resembles).min(Comparator.comparingDouble(ModeFit::error));
    }

    /** Whether it is like the fish at all: nearer than no motion by a fifth, and not only once it has been made tiny. */
    public boolean resembles() {
        return resembles(relative(), alpha);
    }

    /** The same of means over several runs. */
    public static boolean resembles(double relative, double alpha) {
        return relative <= UNLIKE && alpha >= LEAST_ALPHA;
    }

    /** e as a share of what a spine has that does not move. */
    public double relative() {
        return error / (none == null ? 1.0 / 3 : none);
    }

    private static double[] places(double end) {
        double[] places = new double[PLACES];
        Arrays.setAll(places, i -> end * i / (PLACES - 1));
        return places;
    }

    private static ModeFit least(FishMode mode, Sums sums, double frequency) {
        ModeFit best = null;
        double none = (sums.sineSine + sums.cosineCosine) / 2 / sums.count;
        for (int step = 0; step * STEP < 1 / frequency; step++) {
            double beta = step * STEP;
            double angle = 2 * Math.PI * frequency * beta;
            double alpha = sums.swimmer == 0 ? 0
                    : Math.max(0, Math.round(sums.product(angle) / sums.swimmer / STEP) * STEP);
            double error = (sums.real(angle) - 2 * alpha * sums.product(angle) + alpha * alpha * sums.swimmer)
                    / sums.count;
            if (best == null || error < best.error) {
                best = new ModeFit(mode, Math.max(error, 0), alpha, beta, none);
            }
        }
        return best;
    }

    /** Weighted sums over all frames and places. */
    private static final class Sums {
        private double sineSine;
        private double sineCosine;
        private double cosineCosine;
        private double sineSwimmer;
        private double cosineSwimmer;
        private double swimmer;
        private long count;

        /** A place: the real spine, the same a quarter of a beat later in phase, and the simulated one. */
        void add(double weight, double sine, double cosine, double simulated) {
            sineSine += weight * sine * sine;
            sineCosine += weight * sine * cosine;
            cosineCosine += weight * cosine * cosine;
            sineSwimmer += weight * sine * simulated;
            cosineSwimmer += weight * cosine * simulated;
            swimmer += weight * simulated * simulated;
            count++;
        }

        /** Of the real spine's square, shifted by an angle. */
        double real(double angle) {
            double c = Math.cos(angle);
            double s = Math.sin(angle);
            return c * c * sineSine + 2 * c * s * sineCosine + s * s * cosineCosine;
        }

        /** Of the product of both spines. */
        double product(double angle) {
            return Math.cos(angle) * sineSwimmer + Math.sin(angle) * cosineSwimmer;
        }
    }
}
