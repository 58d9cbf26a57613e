package io.natator.verdict;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.checkpoint.BestGait;
import io.natator.config.Numbers;
import io.natator.simulator.SimulationResult;
import java.util.Locale;

/**
 * Whether a gait swims, judged by one run in water and one of the same length without water. The signs of both distances
 * count: what goes backwards does not swim forwards, and drift in vacuum speaks against a gait in either direction.
 *
 * @param kind   the verdict
 * @param text   the same in words, on one line, with the numbers that it rests on
 * @param advice what to try where it does not swim, or may not; null where it does
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record Verdict(Kind kind, String text, String advice) {

    /** What moves less than this in a whole run does not swim: body lengths, or scene units where the length is unknown. */
    static final double LEAST_DISTANCE = 0.05;
    /** Drift in vacuum up to this share of the speed in water is none. */
    static final double NO_DRIFT = 0.1;
    /** From this share on the drift is the motion. */
    static final double DRIFT_ONLY = 0.5;
    /** What touches a wall sooner than this many body lengths (or units) from its start has not shown how it swims. */
    static final double WAY_TO_WALL = 0.5;

    private static final String CONSERVING = "conserving";
    private static final String NEUTRAL = "try --scene pool/creature-N or, finer and slower, "
            + "open-water/creature-N, whose scheme keeps momentum";
    private static final String HONEST = NEUTRAL + "; or --fitness net, which takes off the drift in vacuum";
    private static final String SINKS = "bodies are heavier than the thesis' incompressible water and sink; try --scene "
            + "pool/creature-N or, finer and slower, open-water/creature-N";
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
        Verdict verdict = of(best.result(), best.vacuum(), best.bodyLength());
        boolean sinks = best.scene().startsWith("thesis/") && CONSERVING.equals(best.result().scheme());
        return sinks && verdict.advice != null ? new Verdict(verdict.kind, verdict.text, SINKS) : verdict;
    }

    /**
     * The verdict on a gait.
     *
     * @param water      what it did in water
     * @param vacuum     what it did without, or null if that was not tried
     * @param bodyLength in scene units, or null if that is unknown
     */
    public static Verdict of(SimulationResult water, SimulationResult vacuum, Double bodyLength) {
        if (water.status() != SimulationResult.Status.OK) {
            return unproven("not judged: " + why(water), LONGER);
        }
        Length length = bodyLength != null && bodyLength > 0 ? new Length(bodyLength, "body lengths")
                : new Length(1, "units");
        double way = water.distance() / length.unit();
        if (Math.abs(way) < LEAST_DISTANCE) {
            return new Verdict(Kind.DOES_NOT_SWIM, "does not swim: moves " + Numbers.fixed(way, 2) + " " + length.name()
                    + " in " + seconds(water) + ", less than " + LEAST_DISTANCE, LONGER);
        }
        String moves = length.speed(water.speed());
        if (vacuum == null) {
            return unproven("not judged: moves at " + moves + "; not run in vacuum yet", null);
        }
        if (vacuum.status() != SimulationResult.Status.OK) {
            return unproven("not judged: moves at " + moves + "; no result in vacuum, " + why(vacuum), null);
        }
        return judged(water, vacuum, length, moves + ", " + Numbers.fixed(vacuum.speed() / length.unit(), 2) + " in vacuum");
    }

    /** By the drift first, since that is no swimming wherever it leads. */
    private static Verdict judged(SimulationResult water, SimulationResult vacuum, Length length, String speeds) {
        boolean keepsMomentum = CONSERVING.equals(water.scheme());
        double drift = vacuum.speed() / water.speed();
        if (Math.abs(drift) >= DRIFT_ONLY) {
            return new Verdict(Kind.DOES_NOT_SWIM, "does not swim: moves " + times(drift, water, vacuum),
                    keepsMomentum ? LONGER : HONEST);
        }
        if (water.distance() < 0) {
            return new Verdict(Kind.DOES_NOT_SWIM, "does not swim forwards: " + speeds, LONGER);
        }
        if (water.stopped().equals("no-progress")) {
            return new Verdict(Kind.DOES_NOT_SWIM, "does not swim: comes to rest, no progress at " + seconds(water), LONGER);
        }
        String end = "";
        if (water.stopped().equals("touched-plane")) {
            end = ", until it touches a wall at " + seconds(water);
            if (water.distance() / length.unit() < WAY_TO_WALL) {
                return unproven("not judged: " + speeds + end, LONGER);
            }
        }
        if (Math.abs(drift) > NO_DRIFT) {
            return unproven("may swim: " + speeds + end + "; moves " + times(drift, water, vacuum),
                    keepsMomentum ? LONGER : HONEST);
        }
        return keepsMomentum ? new Verdict(Kind.SWIMS, "swims: " + speeds + end, null)
                : unproven("may swim: " + speeds + end + "; no proof, since scheme flex does not keep momentum", NEUTRAL);
    }

    private static Verdict unproven(String text, String advice) {
        return new Verdict(Kind.UNPROVEN, text, advice);
    }

    /** Runs of other lengths, as old folders have them, are compared by their mean speeds. */
    private static String times(double drift, SimulationResult water, SimulationResult vacuum) {
        double size = Math.abs(drift);
        boolean sameTime = Math.abs(water.simulated() - vacuum.simulated()) < 1e-6;
        return Numbers.fixed(size, size < 9.95 ? 1 : 0) + " times as " + (sameTime ? "far" : "fast") + " in vacuum"
                + (drift < 0 ? ", the other way" : "");
    }

    private static String why(SimulationResult result) {
        return result.error() != null ? result.error() : result.status() == SimulationResult.Status.UNSTABLE
                ? "unstable at " + seconds(result) : result.status().name().toLowerCase(Locale.ROOT);
    }

    private static String seconds(SimulationResult result) {
        return Numbers.fixed(result.simulated(), 2) + " s";
    }

    /** What lengths are told in. */
    private record Length(double unit, String name) {

        String speed(double unitsPerSecond) {
            return Numbers.fixed(unitsPerSecond / unit, 2) + " " + name + "/s";
        }
    }
}
