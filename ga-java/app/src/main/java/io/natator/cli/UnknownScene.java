package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.config.Preset;
import io.natator.process.ProgramInfo;
import io.natator.protocol.RefusedSceneException;
import io.natator.protocol.RequestRejectedException;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.stream.Stream;

/** What to say of a scene that the simulator does not have: which names are near, not all that there are. */
final class UnknownScene {

    private static final String WATER = "water";

    private UnknownScene() {
    }

    /**
     * The refusal of a run folder or scene, in other words if it is neither.
     *
     * @param source  as typed
     * @param refusal of the simulator
     */
    static InvalidInputException source(String source, RefusedSceneException refusal, Path simulator)
            throws InterruptedException {
        List<String> known = known(simulator);
        return isKnown(source, known) ? refusal
                : new InvalidInputException(
                        source + " is neither a run folder nor a scene" + Closest.scenes(source, known), refusal);
    }

    /** The refusal of the scene that an option names, likewise. */
    static InvalidInputException scene(String option, String scene, RefusedSceneException refusal, Path simulator)
            throws InterruptedException {
        List<String> known = known(simulator);
        return isKnown(scene, known) ? refusal : new InvalidInputException(option + " is " + scene
                + "; expected a named scene (natator-sim info lists them) or a file NAME.json"
                + Closest.scenes(scene, known), refusal);
    }

    /**
     * The refusal of what {@code --creature} names, likewise.
     *
     * @param scene of the creature
     */
    static InvalidInputException creature(String creature, String scene, RefusedSceneException refusal, Path simulator)
            throws InterruptedException {
        List<String> known = known(simulator);
        if (isKnown(scene, known)) {
            return refusal;
        }
        List<String> bodies = bodies(known);
        return new InvalidInputException("--creature is " + creature + "; expected "
                + EnumNames.choice(Stream.concat(Stream.of("1", "2", "3", "4"), bodies.stream()).toList())
                + Closest.hint(creature, bodies), refusal);
    }

    /** Bodies without a number that are in the water of every preset. */
    private static List<String> bodies(List<String> known) {
        return known.stream().map(name -> name.substring(name.lastIndexOf('/') + 1)).distinct()
                .filter(name -> !name.equals(WATER) && !name.startsWith("creature-"))
                .filter(name -> Arrays.stream(Preset.values()).allMatch(preset -> known.contains(preset.sceneOf(name))))
                .toList();
    }

    /** Also where nobody can tell, or it is a file: then what the simulator said is all there is to say. */
    private static boolean isKnown(String scene, List<String> known) {
        return known.isEmpty() || scene.endsWith(".json") || known.contains(scene);
    }

    private static List<String> known(Path simulator) throws InterruptedException {
        try {
            return ProgramInfo.of(simulator).scenes();
        } catch (InvalidInputException | RequestRejectedException e) {
            return List.of();
        }
    }
}
