package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.cli.Section.Topic;
import io.natator.config.Preset;
import java.util.Arrays;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;

/** Options that choose one scene. */
@Section(Topic.SCENE)
final class SceneChoice {

    @Option(names = "--creature", paramLabel = "1..4|NAME",
            description = "Creature of the thesis, or another bundled body: eel, ray, tadpole, tuna; with the preset quick loach.")
    private String creature;

    @Option(names = "--scene", paramLabel = "NAME|FILE",
            description = "Default: thesis/creature-N; of evolve the preset's, without a creature plane/loach.")
    private String scene;

    /** Whether either was given. */
    boolean isGiven() {
        return creature != null || scene != null;
    }

    /** Whether a scene is the one that was named, or the chosen creature's as any preset has it; any if none was given. */
    boolean admits(String other) {
        return scene != null ? SceneOptions.scene("--scene", scene).equals(other)
                : creature == null
                        || Arrays.stream(Preset.values()).anyMatch(one -> one.sceneOf(creature).equals(other));
    }

    /** The scene as {@link SceneOptions#scene} has it; by number, or if none is given, in the thesis' tank. */
    String scene(CommandSpec command) {
        return scene(command, Preset.THESIS);
    }

    /** The scene as {@link SceneOptions#scene} has it; by number, or if none is given, the preset's. */
    String scene(CommandSpec command, Preset preset) {
        if (creature != null && scene != null) {
            throw new ParameterException(command.commandLine(), "--creature and --scene exclude each other");
        }
        if (creature != null && !Preset.isCreature(creature)) {
            throw new InvalidInputException("--creature is " + creature
                    + "; expected 1, 2, 3 or 4, or the name of a bundled body such as eel");
        }
        if (scene != null) {
            return SceneOptions.scene("--scene", scene);
        }
        return creature != null ? preset.sceneOf(creature) : preset.scene();
    }
}
