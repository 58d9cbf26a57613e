package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.cli.Section.Topic;
import java.nio.file.Files;
import java.nio.file.Path;
import picocli.CommandLine.Option;

/** Options that change what is simulated. */
@Section(Topic.SCENE)
final class SceneOptions extends SceneChanges {

    @Option(names = "--duration", paramLabel = "SECONDS",
            description = "Simulated time, to the nearest frame. Default: the run's or the preset's, else the scene's "
                    + "(4 for the thesis scenes).")
    private Double duration;

    Double duration() {
        return duration;
    }

    /**
     * The scene as the simulator is to find it from any working directory: files by their absolute path.
     *
     * @param option by which it was given, for the message
     * @throws InvalidInputException if it is a file that is not there
     */
    static String scene(String option, String given) {
        if (!given.endsWith(".json")) {
            return given;
        }
        Path file = Path.of(given);
        if (!Files.isRegularFile(file)) {
            throw new InvalidInputException(option + " is " + given + "; expected a named scene or an existing file");
        }
        return file.toAbsolutePath().normalize().toString();
    }

    /** A name for files: the last part of a scene's name, or of its file's. */
    static String shortName(String scene) {
        return Path.of(scene).getFileName().toString().replaceFirst("\\.json$", "");
    }
}
