package io.natator.view;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.stream.StreamException;
import io.natator.stream.StreamOptions;
import io.natator.stream.StreamProcess;
import io.natator.stream.StreamScene;
import java.nio.file.Path;
import java.util.stream.Stream;

/**
 * What a simulator was told to do: all that another one must be told that takes its place. Not for several threads at
 * once.
 */
final class SessionState {

    /** Options of the scene when it began. */
    private StreamOptions options;
    private boolean paused;
    private JsonNode rate;

    /**
     * The course of a simulator that is started with a command.
     *
     * @param policy that drives the swimmer, or null
     */
    SessionState(ClientCommand start, Path policy) {
        paused = start.option("paused");
        options = StreamOptions.live(start.scene(), start.object("overrides"), start.object("gait"), paused)
                .withPolicy(policy);
    }

    /** What to start a simulator with. */
    StreamOptions options() {
        return StreamOptions.live(options.scene(), options.overrides(), options.gait(), paused)
                .with(null, options.precision()).withPolicy(options.policy());
    }

    /** Notes a command that goes to the simulator. */
    void follow(ClientCommand command) {
        switch (command.what()) {
            case "run" -> paused = false;
            case "pause", "step" -> paused = true;
            case "rate" -> rate = command.content();
            case "scene" -> options = options.withPolicy(null);
            default -> {
                // What changes the scene is told by the simulator, if it accepts it.
            }
        }
        JsonNode content = command.content();
        boolean drives = Stream.of("gait", "drive", "scale", "offset").anyMatch(content::has)
                || command.what().equals("steer");
        if (drives && content.path("swimmer").asInt(0) == 0) {
            options = options.withPolicy(null);
        }
    }

    /** Notes what runs now. */
    void follow(StreamScene scene) {
        options = StreamOptions.live(scene.scene(), scene.overrides(), scene.gait(), paused)
                .with(null, scene.precision()).withPolicy(options.policy());
    }

    /** Tells a fresh simulator what is not in its options. Credit is the page's to grant anew. */
    void takeUp(StreamProcess process) throws StreamException {
        if (rate != null) {
            process.send(rate);
        }
    }
}
