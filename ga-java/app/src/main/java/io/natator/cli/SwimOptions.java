package io.natator.cli;

import io.natator.cli.Section.Topic;
import java.nio.file.Path;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

/** Which swim: that of a run, or of a scene. */
@Section(Topic.SCENE)
final class SwimOptions {

    @Parameters(paramLabel = "RUN|SCENE", description = "A run folder of evolve (its best gait), or a scene: a name as "
            + "thesis/creature-1, or a file.")
    private String source;

    @Option(names = "--gait", paramLabel = "FILE",
            description = "A JSON file with a gait, or a run's best.json. A scene without one is at rest.")
    private Path gait;

    @Option(names = "--generation", paramLabel = "N",
            description = "Of a run: the best gait of the generations up to N instead of all.")
    private Integer generation;

    /** The run folder or scene as the user wrote it. */
    String source() {
        return source;
    }

    /** See {@link SwimSource#of(String, Integer, Path)}. */
    SwimSource swimmer() {
        return SwimSource.of(source, generation, gait);
    }
}
