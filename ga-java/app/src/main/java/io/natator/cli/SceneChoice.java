package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.cli.Section.Topic;
import io.natator.config.Preset;
import io.natator.process.ProgramInfo;
import io.natator.process.SceneInfo;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.TreeSet;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;

/** Options that choose one scene. */
@Section(Topic.SCENE)
final class SceneChoice {

    @Option(names = "--creature", paramLabel = "1..4|NAME",
            description = "Creature of the thesis, or another bundled body: eel, ray, tadpole, tuna; with the preset quick also "
                    + "jellyfish, loach, torus, turtle.")
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

    /**
     * Looks whether the simulator has a scene with the chosen creature, if one was; not by one that names no scenes.
     *
     * @throws InvalidInputException that names the creatures of the preset's scenes
     */
    void checkCreature(Preset preset, Path simulator) throws InterruptedException {
        if (creature == null) {
            return;
        }
        List<String> scenes = ProgramInfo.of(simulator).scenes();
        if (!scenes.isEmpty() && !scenes.contains(preset.sceneOf(creature))) {
            throw new InvalidInputException("--creature " + creature + ": no scene " + preset.sceneOf(creature)
                    + "; expected one of " + String.join(", ", creatures(preset, simulator)));
        }
    }

    /** The creatures that a preset has scenes of, by the names that are typed. */
    static List<String> creatures(Preset preset, Path simulator) throws InterruptedException {
        List<String> scenes = ProgramInfo.of(simulator).scenes();
        List<String> creatures = new ArrayList<>();
        for (String name : new TreeSet<>(scenes.stream().map(SceneOptions::shortName).toList())) {
            String scene = preset.sceneOf(name);
            if (scenes.contains(scene) && name.equals(SceneInfo.creature(scene, simulator))) {
                creatures.add(name.replaceFirst("^creature-(?=[1-4]$)", ""));
            }
        }
        return creatures;
    }
}
