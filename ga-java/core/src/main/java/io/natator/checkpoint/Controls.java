package io.natator.checkpoint;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.body.Swimmer;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.file.AtomicFile;
import io.soabase.recordbuilder.core.RecordBuilder;
import java.nio.file.Path;
import java.util.Objects;

/**
 * A winner beside what should not swim, and beside itself under other conditions; {@code check.json}. All samples are of
 * the same starts, which no generation had.
 *
 * @param gait         of the winner
 * @param body         of the winner, as in {@code best.json}, or null
 * @param scheme       the scheme used
 * @param duration     of a run that nothing ends early, in seconds
 * @param bodyLength   in scene units, or null
 * @param water        as in the run
 * @param resting      with muscles that do nothing: what a dead body drifts
 * @param vacuum       without water
 * @param clampOff     without the clamp of accelerations; null but in scheme flex, which alone has it
 * @param halfStep     at half the time step
 * @param mirrored     with left and right exchanged
 * @param otherBackend on a GPU if the run was on the processor, and the other way round; null without a GPU
 * @param backend      which that is; null likewise
 * @param underWater   share of the body's particles below the water's level, halfway and at the end; null without water
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
@RecordBuilder
public record Controls(Gait gait, JsonNode body, String scheme, double duration, Double bodyLength, SwimSample water,
        SwimSample resting,
        SwimSample vacuum, SwimSample clampOff, SwimSample halfStep, SwimSample mirrored, SwimSample otherBackend,
        String backend, Double underWater) implements AboutWinner, ControlsBuilder.With {

    /** Requires the gait and the swims that every winner has. */
    public Controls {
        Objects.requireNonNull(gait, "gait");
        Objects.requireNonNull(water, "water");
        Objects.requireNonNull(resting, "resting");
        Objects.requireNonNull(vacuum, "vacuum");
        Objects.requireNonNull(halfStep, "halfStep");
        Objects.requireNonNull(mirrored, "mirrored");
    }

    /** Distance of the swimmer less that of the dead body, in scene units. */
    public double net() {
        return water.distance().mean() - resting.distance().mean();
    }

    /** Standard error of {@link #net()}. */
    public double error() {
        double swimming = water.distance().sd();
        double drifting = resting.distance().sd();
        return Math.sqrt(swimming * swimming / water.runs() + drifting * drifting / resting.runs());
    }

    /** Keeps them in a run folder. */
    public void write(Path run) {
        AtomicFile.write(run.resolve(RunWriter.CONTROLS), Json.document(this));
    }

    /**
     * Those of a run folder, if they are of its winner.
     *
     * @return null if there are none
     */
    public static Controls of(Path run, Swimmer best) {
        return AboutWinner.in(run, RunWriter.CONTROLS, Controls.class, best);
    }
}
