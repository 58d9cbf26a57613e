package io.natator.protocol;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.base.Numbers;
import io.soabase.recordbuilder.core.RecordBuilder;
import java.util.List;
import java.util.Objects;

/**
 * What came of an evaluation; the JSON form is {@code sim-native/protocol/result.schema.json}, of which unknown fields
 * are ignored, with the statuses {@code failed} and {@code refused} and the drift in vacuum in addition.
 *
 * @param id        the request's, or null if the simulator could not read it
 * @param status    how it ended
 * @param distance  with {@code ok}: change of the mean x of the body particles in scene units, negative is backwards
 *                  (thesis 2.6); else null
 * @param stopped   why the simulation ended: completed, touched-plane, no-progress or unstable; null if it failed
 * @param simulated simulated time until then in seconds, or null if it failed
 * @param frames    frames until then, or null if it failed
 * @param scheme    the scheme used, or null if it failed
 * @param precision the floating-point type used, or null if it failed
 * @param hash      hash of the final state, 16 hexadecimal digits, or null
 * @param unstable  with {@code unstable}: where, and which law was broken; else null
 * @param error     with {@code error}, {@code failed} and {@code refused}: why, in one line; with {@code unstable} that it was in
 *                  vacuum; else null
 * @param swimming  dimensionless numbers of the swim, or null: not of every scene, nor of every program
 * @param work      mechanical work of the muscles, in mass times length squared over seconds squared; null if it was not measured
 * @param course    where it went by its own heading, or null: not of every program
 * @param goals     what became of the scene's goals, or null where it has none
 * @param vacuumDrift with fitness net: signed distance of the same gait in vacuum in the same time; else null. Never
 *                  said by the simulator itself
 * @param objectives what it is worth by each of the run's objectives, or null where it has none
 * @param worth      by all of them together, or null likewise
 * @param effort     what the swim took, or null where nobody asked
 */
@JsonIgnoreProperties(ignoreUnknown = true)
@JsonInclude(JsonInclude.Include.NON_NULL)
@RecordBuilder
public record SimulationResult(Long id, Status status, Double distance, String stopped, Double simulated,
        Integer frames, String scheme, String precision, String hash, Instability unstable, String error,
        SwimmingNumbers swimming, Double work, Course course, List<GoalScore> goals, Double vacuumDrift,
        List<Double> objectives, Double worth, Effort effort)
        implements SimulationResultBuilder.With {

    /** Why a simulation ended that {@code stopping.planeContact} ended: its body touched a wall. */
    public static final String AT_WALL = "touched-plane";

    /** Copies the lists; status {@code ok} requires a distance and a time. */
    public SimulationResult {
        Objects.requireNonNull(status, "status");
        if (status == Status.OK) {
            Objects.requireNonNull(distance, "distance");
            Objects.requireNonNull(simulated, "simulated");
        }
        goals = goals == null ? null : List.copyOf(goals);
        objectives = objectives == null ? null : List.copyOf(objectives);
    }

    /** How an evaluation ended. */
    public enum Status {
        /** Simulated to the end or to an early stop. */
        @JsonProperty("ok")
        OK,
        /** It broke a law of mechanics: what it came to is impossible, so it has no distance. */
        @JsonProperty("unstable")
        UNSTABLE,
        /** The simulator refused the request. */
        @JsonProperty("error")
        ERROR,
        /** The body is invalid; nothing was simulated. Never said by the simulator itself. */
        @JsonProperty("refused")
        REFUSED,
        /** No valid answer came, also not at the second attempt. Never said by the simulator itself. */
        @JsonProperty("failed")
        FAILED
    }

    /**
     * Where a simulation became unstable.
     *
     * @param particle index of the particle that broke the law, or had the largest share in it
     * @param stage    stage of the step; {@code frame} or {@code settling} of a law that is looked at after those
     * @param time     simulated time in seconds
     * @param law      that it broke; null from programs that looked for nothing but finite numbers
     */
    @JsonIgnoreProperties(ignoreUnknown = true)
    @JsonInclude(JsonInclude.Include.NON_NULL)
    public record Instability(int particle, String stage, double time, String law) {

        /** The law that all programs know. */
        public static final String FINITE = "finite";

        /** The law that was broken: one that is not told is {@link #FINITE}. */
        public String lawOrFinite() {
            return law == null ? FINITE : law;
        }
    }

    /** The record of an evaluation that got no valid answer. */
    public static SimulationResult failed(long id, String reason) {
        return SimulationResultBuilder.builder().id(id).status(Status.FAILED).error(reason).build();
    }

    /** The record of a body that was not simulated. */
    public static SimulationResult refused(long id, String reason) {
        return SimulationResultBuilder.builder().id(id).status(Status.REFUSED).error(reason).build();
    }

    /** The law that an unstable simulation broke; null of any other. */
    public String brokenLaw() {
        return status != Status.UNSTABLE ? null : unstable == null ? Instability.FINITE : unstable.lawOrFinite();
    }

    /** What became of an unstable simulation, in words: when it ended and which law it broke. */
    public String whyUnstable() {
        Double time = unstable != null ? Double.valueOf(unstable.time()) : simulated;
        return "unstable" + (time == null ? "" : " at " + Numbers.fixed(time, 2) + " s")
                + (unstable == null || unstable.law() == null ? "" : " (broke law " + unstable.law() + ")");
    }

    /** This result with what it is worth. */
    public SimulationResult withWorth(List<Double> byObjective, double together) {
        return with(to -> to.objectives(byObjective).worth(together));
    }

    /** The signed distance swum, or 0 where there is none because the evaluation was unstable or failed. */
    public double distanceOrZero() {
        return status == Status.OK ? distance : 0.0;
    }

    /**
     * What is to be great: the worth by the run's objectives if it has any, else by the scene's goals if that has any, else
     * {@link #netDistance()}.
     */
    public double score() {
        return worth != null ? worth : goals != null ? goalScore() : netDistance();
    }

    /** The weighted sum of the scores of the scene's goals; 0 without any, and where the evaluation was unstable or failed. */
    public double goalScore() {
        return goals == null || status != Status.OK ? 0
                : goals.stream().mapToDouble(goal -> goal.weight() * goal.score()).sum();
    }

    /**
     * The signed distance swum, or 0 where there is none; less the drift in vacuum if that is known and forwards. A drift
     * backwards is no merit and adds nothing.
     */
    public double netDistance() {
        return distanceOrZero() - (vacuumDrift == null ? 0.0 : Math.max(vacuumDrift, 0.0));
    }

    /**
     * Whether it ended before its time though nothing was wrong. What would have been ended with the last frame was simulated whole,
     * whatever {@code stopped} says.
     *
     * @param duration of an evaluation that nothing ends early, rounded to frames by the simulator
     */
    public boolean isStoppedEarly(double duration) {
        return status == Status.OK && !"completed".equals(stopped) && duration - simulated > halfFrame();
    }

    private double halfFrame() {
        return frames == null || frames == 0 ? 0 : simulated / frames / 2;
    }

    /**
     * Time simulated in seconds; what was unstable or failed counts as if it had lasted to the end, what was refused as nothing.
     *
     * @param duration of an evaluation that nothing ends early
     */
    public double simulatedOf(double duration) {
        if (status == Status.REFUSED) {
            return 0;
        }
        return isStoppedEarly(duration) ? simulated : duration;
    }

    /** Mean speed over the simulated time in scene units per second, or 0 where there is no distance. */
    public double speed() {
        return status == Status.OK && simulated > 0 ? distance / simulated : 0.0;
    }
}
