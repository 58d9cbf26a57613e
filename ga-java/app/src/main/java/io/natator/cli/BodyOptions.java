package io.natator.cli;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.cli.Section.Topic;
import io.natator.config.BodyEvolution;
import io.natator.config.Evolved;
import io.natator.process.SceneInfo;
import java.nio.file.Path;
import picocli.CommandLine.Option;

/** Options that say whether bodies are evolved. */
@Section(Topic.SEARCH)
final class BodyOptions {

    @Option(names = "--evolve", paramLabel = "WHAT", defaultValue = "gait", description = "gait, body or both: of a creature "
            + "that is given by a profile, its length, sections, joints, stiffness and muscle strength too, with the scene's volume "
            + "and strength in all. Default: ${DEFAULT-VALUE}.")
    private Evolved evolve;

    @Option(names = "--gait", paramLabel = "FILE", description = "With --evolve body: what all bodies swim with, a JSON file with a "
            + "gait or a run's best.json.")
    private Path gait;

    /** What to change of the body; null for nothing. */
    BodyEvolution evolution(String scene, JsonNode overrides, Path simulator) throws InterruptedException {
        if ((evolve == Evolved.BODY) != (gait != null)) {
            throw new InvalidInputException(gait == null ? "--evolve body has no gait that the bodies are to swim with; expected "
                    + "--gait FILE, or --evolve both" : "--gait is for --evolve body; else gaits are evolved");
        }
        return evolve == Evolved.GAIT ? null : new BodyEvolution(evolve,
                SceneInfo.bodyToEvolve(scene, overrides, simulator), gait == null ? null : GaitFile.read(gait).gait());
    }
}
