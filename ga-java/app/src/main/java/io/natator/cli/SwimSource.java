package io.natator.cli;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.body.Swimmer;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.JudgedGait;
import io.natator.checkpoint.SceneDigest;
import io.natator.checkpoint.StoredRun;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.config.Limits;
import io.natator.config.MergePatch;
import io.natator.config.Scheme;
import io.natator.encoding.Gait;
import io.natator.simulator.RefusedSceneException;
import io.natator.simulator.SceneInfo;
import io.natator.verdict.Reproduction;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.Objects;

/**
 * Who swims where: a run's best swimmer in its scene, or a scene with or without a gait.
 *
 * @param run        its folder, or null
 * @param generation up to which it is the best, or null for all
 * @param scene      name or path
 * @param overrides  JSON Merge Patch on the scene, with the body if that is not the scene's; or null
 * @param gait       or null for a body at rest
 * @param scheme     or null for the scene's own
 * @param duration   of an evaluation in seconds, or null for the scene's own
 * @param best       what the run has stored of the gait, if it is the best of all; else null
 */
record SwimSource(Path run, Integer generation, String scene, JsonNode overrides, Gait gait, Scheme scheme,
        Double duration, BestGait best) {

    /**
     * Whom the user named.
     *
     * @param source     a run folder, else a scene
     * @param generation of a run, or null
     * @param gait       a file, or null for a run's best
     * @throws InvalidInputException if the run has no such gait, or a scene's file is not there
     */
    static SwimSource of(String source, Integer generation, Path gait) {
        Swimmer given = gait == null ? null : GaitFile.read(gait);
        if (generation != null && given != null) {
            throw new InvalidInputException("--generation and --gait: expected one of them");
        }
        Path folder = Path.of(source);
        if (StoredRun.exists(folder)) {
            StoredRun run = StoredRun.in(folder);
            Swimmer swimmer = given != null ? given : best(run, generation);
            return of(run, generation, swimmer, given == null && generation == null ? run.best() : null);
        }
        if (generation != null) {
            throw new InvalidInputException("--generation: " + source + " is not a run folder");
        }
        if (source.endsWith(".json") && !Files.isRegularFile(Path.of(source))) {
            throw new InvalidInputException(source + " is neither a run folder nor a scene: there is no such file");
        }
        return new SwimSource(null, null, SceneOptions.scene("scene", source), given == null ? null : given.body(),
                given == null ? null : given.gait(), null, null, null);
    }

    /**
     * A swimmer in a run's scene.
     *
     * @param best what the run has stored of it, or null
     */
    static SwimSource of(StoredRun run, Integer generation, Swimmer swimmer, BestGait best) {
        EvolutionSettings settings = run.settings();
        return new SwimSource(run.directory(), generation, SceneOptions.scene("scene of " + run.directory(), settings.scene()),
                MergePatch.both(settings.overrides(), swimmer.body()), swimmer.gait(), settings.scheme(), settings.duration(), best);
    }

    private static Swimmer best(StoredRun run, Integer generation) {
        if (generation == null) {
            if (run.best() == null) {
                throw new InvalidInputException(run.whyNoBest() + "; or give a gait by --gait");
            }
            return run.best().swimmer();
        }
        int last = run.state() == null ? -1 : run.state().generation();
        if (generation < 0 || generation > last) {
            throw new InvalidInputException("--generation is " + generation + "; expected one that " + run.directory()
                    + " has finished, 0 to " + last);
        }
        JudgedGait found = run.bestUntil(generation);
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

    /**
     * Whether a program of today repeats what is stored.
     *
     * @param changes to the scene, the scheme or the precision by the user: null for none
     * @return null if nothing that can be compared is stored
     */
    Reproduction reproduction(Path simulator, Object... changes) {
        boolean same = best != null && Arrays.stream(changes).allMatch(Objects::isNull);
        return same ? new Reproduction(run, best, simulator, Backend.CPU, 0) : null;
    }

    /** That a run's scene is no longer what it was begun with, in one line; null if it is, or that is not known. */
    String changedScene(Path simulator) throws InterruptedException {
        return run == null || !SceneDigest.isChanged(run, simulator) ? null
                : "scene " + scene + " was changed after " + run + " was begun: the gait swims in another one than it was evolved in";
    }

    /** What simulates a swim. */
    @FunctionalInterface
    interface Simulation<T> {

        T run() throws InterruptedException;
    }

    /**
     * What a simulation of it gives.
     *
     * @param source that the user named
     * @throws InvalidInputException which is about that, if the simulator refuses the scene
     */
    <T> T simulated(String source, Path simulator, Simulation<T> simulation) throws InterruptedException {
        try {
            return simulation.run();
        } catch (RefusedSceneException e) {
            throw run == null ? UnknownScene.source(source, e, simulator) : e;
        }
    }

    /** Its gait as JSON, or null. */
    JsonNode gaitJson() {
        try {
            return gait == null ? null : Json.parse(Json.line(gait), JsonNode.class);
        } catch (JsonProcessingException e) {
            throw new IllegalStateException(e);
        }
    }

    /** What metadata say of it. */
    ObjectNode described() {
        ObjectNode text = JsonNodeFactory.instance.objectNode();
        if (run != null) {
            text.put("run", run.toAbsolutePath().normalize().getFileName().toString());
        }
        if (generation != null) {
            text.put("generation", generation);
        }
        return text;
    }

    /** See {@link SceneOptions#shortName}. */
    String name() {
        return SceneOptions.shortName(scene);
    }
}
