package io.natator.config;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.Numbers;
import io.natator.body.Genome;
import io.natator.encoding.Encoding;
import io.soabase.recordbuilder.core.RecordBuilder;
import java.util.List;
import java.util.Objects;

/**
 * What is to be evolved, in which scene, and what is rewarded.
 *
 * @param scene             name or path of the scene
 * @param encoding          how genes stand for a gait
 * @param actuators         number of actuators of the scene's creature
 * @param scheme            scheme to ask the simulator for, or null for the scene's own
 * @param duration          simulated time in seconds, above 0, or null for the scene's own
 * @param overrides         JSON Merge Patch on the scene, or null
 * @param fitness           what selection rewards
 * @param vacuumCheck       whether the best of a generation, where it is a new best, is also run in vacuum
 * @param objectives        what is to be great instead of the fitness: one, several with weights, or for {@code nsga2}
 *                          several without; null for the fitness
 * @param evolve            bodies to be evolved; null for gaits of the scene's body alone
 */
@RecordBuilder
public record Problem(String scene, EncodingKind encoding, int actuators, Scheme scheme, Double duration,
        JsonNode overrides,
        FitnessKind fitness, Boolean vacuumCheck, List<WeightedObjective> objectives, BodyEvolution evolve)
        implements ProblemBuilder.With {

    /**
     * Checks the ranges and fills in defaults.
     *
     * @throws io.natator.base.InvalidInputException naming the setting that is out of range
     */
    public Problem {
        Objects.requireNonNull(scene, "scene");
        Objects.requireNonNull(encoding, "encoding");
        Limits.require(actuators <= Limits.ACTUATORS, "actuators", actuators, "at most " + Limits.ACTUATORS);
        encoding.forActuators(actuators);  // refuses what it cannot be of
        if (duration != null) {
            Limits.checkDuration("duration", duration);
        }
        fitness = fitness == null ? FitnessKind.DISTANCE : fitness;
        vacuumCheck = vacuumCheck != null && vacuumCheck;
        objectives = objectives == null || objectives.isEmpty() ? null : List.copyOf(objectives);
        Limits.require(evolve == null || evolve.gait() == null || evolve.gait().actuators() == actuators,
                "gait of the bodies",
                evolve == null || evolve.gait() == null ? ""
                        : "for " + Numbers.count(evolve.gait().actuators(), "actuator"),
                "one for the " + actuators + " of the scene's body");
    }

    /** What a gait is worth in this run, for people: a distance has four decimals, and may be nothing. */
    public String worthText(double worth) {
        return objectives == null ? Numbers.fixed(worth, 4) : Numbers.worth(worth);
    }

    /** What genes stand for in this run. */
    public Genome genome() {
        Encoding gaits = encoding.forActuators(actuators);
        return evolve == null ? Genome.ofGait(gaits) : evolve.genome(gaits);
    }

    /**
     * Length of a body that this run evolves.
     *
     * @param patch that gives the scene this body
     */
    public double bodyLength(JsonNode patch) {
        return evolve.body().with(patch).bodyLength();
    }
}
