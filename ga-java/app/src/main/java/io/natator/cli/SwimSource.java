package io.natator.cli;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.base.MergePatch;
import io.natator.body.Swimmer;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.GaitScore;
import io.natator.checkpoint.RunReader;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.config.Limits;
import io.natator.config.Scheme;
import io.natator.encoding.Gait;
import io.natator.process.SceneInfo;
import java.nio.file.Files;
import java.nio.file.Path;

/**
 * A swimmer and its scene: a run's best swimmer in its scene, or a scene with or without a gait.
 *
 * @param run        its folder, or null
 * @param scene      name or path
 * @param overrides  JSON Merge Patch on the scene, with the body if that is not the scene's; or null
 * @param gait       or null for a body at rest
 * @param scheme     or null for the scene's own
 * @param duration   of an evaluation in seconds, or null for the scene's own
 * @param best       what the run has stored of the gait, if it is the best of all; else null
 */
record SwimSource(Path run, String scene, JsonNode overrides, Gait gait, Scheme scheme,
        Double duration, BestGait best) {

    /**
     * The swimmer that the user named.
     *
     * @param source     a run folder, else a scene
     * @param gait       a file, or null for a run's best
     * @throws InvalidInputException if the run has no such gait, or a scene's file is not there
     */
    static SwimSource of(String source, Path gait) {
        Swimmer given = gait == null ? null : GaitFile.read(gait);
        Path folder = Path.of(source);
        if (RunReader.exists(folder)) {
            RunReader run = RunReader.in(folder);
            return of(run, given != null ? given : best(run), given == null ? run.best() : null);
        }
        if (source.endsWith(".json") && !Files.isRegularFile(Path.of(source))) {
            throw new InvalidInputException(source + " is neither a run folder nor a scene: there is no such file");
        }
        return new SwimSource(null, SceneOptions.scene("scene", source), given == null ? null : given.body(),
                given == null ? null : given.gait(), null, null, null);
    }

    /**
     * A swimmer in a run's scene.
     *
     * @param best what the run has stored of it, or null
     */
    static SwimSource of(RunReader run, Swimmer swimmer, BestGait best) {
        EvolutionSettings settings = run.settings();
        return new SwimSource(run.directory(),
                SceneOptions.scene("scene of " + run.directory(), settings.problem().scene()),
                MergePatch.both(settings.problem().overrides(), swimmer.body()), swimmer.gait(),
                settings.problem().scheme(), settings.problem().duration(), best);
    }

    private static Swimmer best(RunReader run) {
        if (run.best() == null) {
            throw new InvalidInputException(run.whyNoBest() + "; or give a gait by --gait");
        }
        return run.best().swimmer();
    }

    /**
     * The best of the generations up to one.
     *
     * @throws InvalidInputException if the run has not finished that one, or no longer knows it
     */
    static Swimmer bestUntil(int generation, RunReader run) {
        int last = run.state() == null ? -1 : run.state().generation();
        if (generation < 0 || generation > last) {
            throw new InvalidInputException("--generation is " + generation + "; expected one that " + run.directory()
                    + " has finished, 0 to " + last);
        }
        GaitScore found = run.bestUntil(generation);
        if (found == null) {
            throw new InvalidInputException(run.directory() + " no longer knows the gaits of generation " + generation
                    + ", only the best of all; leave out --generation");
        }
        return found.swimmer();
    }

    /**
     * How long to simulate.
     *
     * @param given     by the user, s, or null
     * @param overrides on the scene, or null
     * @throws InvalidInputException if that is no time, or the simulator does not know the scene
     */
    double seconds(Double given, JsonNode overrides, Path simulator) throws InterruptedException {
        Double known = given != null ? given : duration;
        double seconds = known != null ? known : SceneInfo.of(scene, overrides, simulator).duration();
        Limits.checkDuration("--duration", seconds);
        return seconds;
    }

    /** Its gait as JSON, or null. */
    JsonNode gaitJson() {
        try {
            return gait == null ? null : Json.parse(Json.line(gait), JsonNode.class);
        } catch (JsonProcessingException e) {
            throw new IllegalStateException(e);
        }
    }

    /** See {@link SceneOptions#shortName}. */
    String name() {
        return SceneOptions.shortName(scene);
    }
}
