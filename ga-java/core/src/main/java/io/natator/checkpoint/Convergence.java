package io.natator.checkpoint;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.body.Swimmer;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.file.AtomicFile;
import io.natator.protocol.FinerLevel;
import java.nio.file.Path;
import java.util.List;
import java.util.Objects;

/**
 * How far a winner's speed depends on the time step and on the spacing of the particles, as {@code natator-sim converge} answers;
 * {@code converge.json}. Errors are standard errors, lengths are scene units.
 *
 * @param gait       of the winner
 * @param body       of the winner, as in {@code best.json}, or null
 * @param bodyLength in scene units, or null
 * @param levels     the run's own first
 * @param estimate   for time step and spacing 0; null if no run of a level was stable
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
@JsonIgnoreProperties(ignoreUnknown = true)
public record Convergence(Gait gait, JsonNode body, Double bodyLength, List<Level> levels, Estimate estimate)
        implements AboutWinner {

    /**
     * The swim at one size of steps.
     *
     * @param level    its name: {@code base}, {@code time/2}, {@code spacing/2} …
     * @param runs     that were stable
     * @param unstable that were not, and are left out
     * @param change   of the speed from that of the first level, as a share of it; null of the first, and without a stable run
     */
    @JsonInclude(JsonInclude.Include.NON_NULL)
    @JsonIgnoreProperties(ignoreUnknown = true)
    public record Level(String level, int runs, int unstable, Value distance, Value speed, Value change) {
    }

    /** A mean and its standard error, null where one run alone was stable. */
    public record Value(double mean, Double error) {
    }

    /** A speed and how well it is known; null where it is not. */
    @JsonIgnoreProperties(ignoreUnknown = true)
    public record Estimate(double speed, Double error) {
    }

    /** The level at half the spacing of the particles, or null if it was not run. */
    public Level halfSpacing() {
        return levels.stream().filter(one -> one.level().equals(FinerLevel.HALF_SPACING.label())).findFirst()
                .orElse(null);
    }

    /** Requires the gait and its levels. */
    public Convergence {
        Objects.requireNonNull(gait, "gait");
        levels = List.copyOf(levels);
    }

    /**
     * Keeps an answer in the folder of a run.
     *
     * @param swimmer the run's winner
     * @param answer  of {@code natator-sim converge}
     * @throws JsonProcessingException if it is no such answer
     */
    public static Convergence write(Path run, Swimmer swimmer, JsonNode answer) throws JsonProcessingException {
        ObjectNode content = Json.tree(answer, ObjectNode.class).deepCopy();
        content.set("gait", Json.tree(swimmer.gait()));
        if (swimmer.body() != null) {
            content.set("body", swimmer.body());
        }
        Convergence convergence = Json.tree(content, Convergence.class);
        AtomicFile.write(run.resolve(RunWriter.CONVERGENCE), Json.document(content));
        return convergence;
    }

    /** The file of a run folder that keeps each run of it. */
    public static Path runs(Path run) {
        return run.resolve(RunWriter.CONVERGENCE_RUNS);
    }

    /**
     * That of a run folder, if it is of its winner.
     *
     * @return null if there is none
     */
    public static Convergence of(Path run, Swimmer best) {
        return AboutWinner.in(run, RunWriter.CONVERGENCE, Convergence.class, best);
    }
}
