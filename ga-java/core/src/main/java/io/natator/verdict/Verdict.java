package io.natator.verdict;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.base.Numbers;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.FreshRuns;
import io.natator.checkpoint.Spread;
import io.natator.checkpoint.SwimSample;
import io.natator.config.Scheme;
import io.natator.protocol.SimulationResult;
import java.util.List;
import java.util.Locale;

/**
 * Whether a gait swims, judged by its runs from fresh starts, or by one run in water where there are none, and one without
 * water.
 * The signs of distances count: what goes backwards does not swim forwards, and drift in vacuum speaks against a gait in
 * either direction.
 *
 * @param kind   the verdict
 * @param text   the same in words, on one line, with the numbers that it rests on
 * @param advice what to try where it does not swim, or may not; null where it does
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record Verdict(Kind kind, String text, String advice) {

    static final String UNTIL_WALL = ", until it touches a wall";

    private static final String NEUTRAL = "try --scene pool/creature-N or, finer and slower, "
            + "open-water/creature-N, whose scheme keeps momentum";
    private static final String HONEST = NEUTRAL + "; or --fitness net, which takes off the drift in vacuum";
    private static final String SINKS = "bodies are heavier than the thesis' incompressible water and sink; try --scene "
            + "pool/creature-N or, finer and slower, open-water/creature-N";
    private static final String FINER = "try more --starts, or the finer open-water/creature-N";
    private static final String LONGER = "try more --generations, a larger --population or another --seed";

    /** Kinds of verdicts. */
    public enum Kind {
        /** Moves forwards in water, by a scheme that keeps momentum, and not in vacuum. */
        @JsonProperty("swims")
        SWIMS,
        /** What is known does not decide it. */
        @JsonProperty("unproven")
        UNPROVEN,
        /** Does not move forwards, or moves without water too. */
        @JsonProperty("does-not-swim")
        DOES_NOT_SWIM
    }

    /** The verdict on a run's best gait. */
    public static Verdict of(BestGait best) {
        Swim swim = best.fresh() == null ? Swim.of(best.result()) : Swim.of(best.fresh(), best.result());
        Verdict verdict = of(swim, best.vacuum(), best.bodyLength());
        boolean sinks = best.scene().startsWith("thesis/") && Scheme.of(best.result().scheme()) == Scheme.CONSERVING;
        return sinks && verdict.advice != null ? new Verdict(verdict.kind, verdict.text, SINKS) : verdict;
    }

    private static Verdict of(Swim water, SimulationResult vacuum, Double bodyLength) {
        if (water.failure() != null) {
            return unproven("not judged: " + water.failure(), LONGER);
        }
        Length length = Length.of(bodyLength);
        double way = water.distance() / length.unit();
        if (isMeasurable(vacuum, bodyLength) && Math.abs(way) < Limit.MIN_DISTANCE) {
            return new Verdict(Kind.DOES_NOT_SWIM, "does not swim: moves " + length.distance(water)
                    + " in " + seconds(water.simulated()) + ", less than " + Limit.MIN_DISTANCE, LONGER);
        }
        String moves = length.speed(water);
        if (vacuum == null) {
            return unproven("not judged: moves at " + moves + "; not run in vacuum yet", null);
        }
        if (vacuum.status() != SimulationResult.Status.OK) {
            return unproven("not judged: moves at " + moves + "; no result in vacuum, " + why(vacuum), null);
        }
        return judge(water, vacuum, length,
                moves + ", " + Numbers.fixed(vacuum.speed() / length.unit(), 2) + " in vacuum");
    }

    /** Judges the drift first, since that is no swimming wherever it leads. */
    private static Verdict judge(Swim water, SimulationResult vacuum, Length length, String speeds) {
        boolean keepsMomentum = water.scheme() != null && water.scheme().keepsMomentum();
        double drift = vacuum.speed() / water.speed();
        if (Math.abs(drift) >= Limit.DRIFT_ONLY) {
            return new Verdict(Kind.DOES_NOT_SWIM, "does not swim: moves " + times(drift, water, vacuum),
                    keepsMomentum ? LONGER : HONEST);
        }
        if (water.distance() < 0) {
            return new Verdict(Kind.DOES_NOT_SWIM, "does not swim forwards: " + speeds, LONGER);
        }
        if (water.stopped().equals("no-progress")) {
            return new Verdict(Kind.DOES_NOT_SWIM, "does not swim: comes to rest, no progress at "
                    + seconds(water.simulated()), LONGER);
        }
        String end = "";
        if (water.stopped().equals(SimulationResult.AT_WALL)) {
            end = UNTIL_WALL + (water.fresh() == null ? " at " + seconds(water.simulated()) : "");
            if (water.distance() / length.unit() < Limit.WAY_TO_WALL) {
                return unproven("not judged: " + speeds + end, LONGER);
            }
        }
        String doubt = water.fresh() == null ? null : doubt(water.fresh(), length);
        if (doubt != null) {
            return unproven("may swim: " + speeds + end + "; " + doubt, FINER);
        }
        if (Math.abs(drift) > Limit.NO_DRIFT) {
            return unproven("may swim: " + speeds + end + "; moves " + times(drift, water, vacuum),
                    keepsMomentum ? LONGER : HONEST);
        }
        return keepsMomentum ? new Verdict(Kind.SWIMS, "swims: " + speeds + end, null)
                : unproven("may swim: " + speeds + end + "; no proof, since scheme flex does not keep momentum",
                        NEUTRAL);
    }

    /** Why fresh runs do not show that it swims; null if they do. */
    private static String doubt(FreshRuns fresh, Length length) {
        SwimSample base = fresh.base();
        for (SwimSample sample : fresh.halfStep() == null ? List.of(base) : List.of(base, fresh.halfStep())) {
            if (sample.unstable() > 0) {
                return instability(sample) + (sample == base ? "" : " at half the time step");
            }
        }
        if (!getsFar(base.distance().mean(), base.distance().standardError(base.runs()), length.unit())) {
            return "the runs differ too much to tell";
        }
        int failed = base.stopped().getOrDefault("failed", 0);
        if (2 * failed > base.runs()) {
            return failed + " of " + base.runs() + " runs failed";
        }
        return fresh.halfStep() == null ? null
                : HalfStep.doubt(base.distance().mean(), fresh.halfStep().distance().mean());
    }

    /** How many of the runs were unstable, which one is enough to doubt. */
    static String instability(SwimSample sample) {
        return sample.unstable() + " of " + Numbers.count(sample.runs(), "run")
                + (sample.unstable() == 1 ? " was" : " were") + " unstable";
    }

    /**
     * Whether a way can be set beside {@link Limit#MIN_DISTANCE}. A run that goes on has neither its body's length nor a
     * result in vacuum; a folder with the latter alone is judged in scene units.
     */
    static boolean isMeasurable(SimulationResult vacuum, Double bodyLength) {
        return bodyLength != null || vacuum != null;
    }

    /**
     * Whether a mean way is beyond doubt more than none.
     *
     * @param error standard error of the way, in its unit
     * @param unit  length of the body in that unit, or 1
     */
    static boolean getsFar(double way, double error, double unit) {
        return (way - Limit.SURE * error) / unit >= Limit.MIN_DISTANCE;
    }

    private static Verdict unproven(String text, String advice) {
        return new Verdict(Kind.UNPROVEN, text, advice);
    }

    /** Compares distances, or mean speeds where one run took longer than the other. */
    private static String times(double drift, Swim water, SimulationResult vacuum) {
        double size = Math.abs(drift);
        boolean sameTime = Math.abs(water.simulated() - vacuum.simulated()) < 1e-6;
        return Numbers.fixed(size, size < 9.95 ? 1 : 0) + " times as " + (sameTime ? "far" : "fast") + " in vacuum"
                + (drift < 0 ? ", the other way" : "");
    }

    private static String why(SimulationResult result) {
        return result.error() != null ? result.error() : result.status() == SimulationResult.Status.UNSTABLE
                ? result.whyUnstable() : result.status().name().toLowerCase(Locale.ROOT);
    }

    private static String seconds(double simulated) {
        return Numbers.fixed(simulated, 2) + " s";
    }

    /**
     * What a gait did in water.
     *
     * @param distance  in scene units
     * @param speed     in scene units per second
     * @param simulated seconds
     * @param stopped   how it, or most of its runs, ended
     * @param scheme    how it was solved
     * @param fresh     the runs that the others are means of; null of one run
     * @param failure   why nothing is known, or null
     */
    private record Swim(double distance, double speed, double simulated, String stopped, Scheme scheme, FreshRuns fresh,
            String failure) {

        static Swim of(SimulationResult one) {
            return one.status() != SimulationResult.Status.OK ? new Swim(0, 0, 0, null, null, null, why(one))
                    : new Swim(one.distance(), one.speed(), one.simulated(), one.stopped(), Scheme.of(one.scheme()),
                            null, null);
        }

        static Swim of(FreshRuns fresh, SimulationResult one) {
            SwimSample base = fresh.base();
            return new Swim(base.distance().mean(), base.speed().mean(), fresh.duration(), base.mostlyStopped(),
                    Scheme.of(one.scheme()), fresh, null);
        }
    }

    /**
     * What lengths are told in.
     *
     * @param unit in scene units
     * @param name of many of it
     */
    record Length(double unit, String name) {

        static final String BODIES = "body lengths";

        /** Body lengths, or scene units where the length is null or 0 since it is unknown. */
        static Length of(Double bodyLength) {
            return bodyLength != null && bodyLength > 0 ? new Length(bodyLength, BODIES) : new Length(1, "units");
        }

        /** With a digit more than the limit that it is set beside. */
        private String distance(Swim swim) {
            return with(swim.distance(), swim.fresh() == null ? null : swim.fresh().base().distance(), 3) + " " + name;
        }

        /** Mean and standard deviation, and the mean at half the time step. */
        private String speed(Swim swim) {
            if (swim.fresh() == null) {
                return with(swim.speed(), null, 2) + " " + name + "/s";
            }
            SwimSample half = swim.fresh().halfStep();
            return with(swim.speed(), swim.fresh().base().speed(), 2) + " " + name + "/s"
                    + (half == null ? ""
                            : ", " + Numbers.fixed(half.speed().mean() / unit, 2) + " at half the time step");
        }

        private String with(double value, Spread spread, int digits) {
            return spread == null ? Numbers.fixed(value / unit, digits)
                    : Numbers.withError(value / unit, spread.sd() / unit, digits);
        }
    }
}
