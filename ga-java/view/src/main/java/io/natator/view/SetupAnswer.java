package io.natator.view;

import io.natator.config.Scheme;
import io.natator.encoding.Gait;
import io.natator.kinematics.FishMode;
import io.natator.process.ProgramInfo;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;
import java.util.stream.IntStream;

/**
 * What the page is told first.
 *
 * @param version of the simulator
 * @param scenes  names of those that come with it
 * @param schemes that there are
 * @param start   what to show
 * @param runs    that can be looked at
 * @param modes   how real fish swim
 * @param gaits   known gaits by the scene that they are for
 */
record SetupAnswer(String version, List<String> scenes, List<Scheme> schemes, InitialScene start, List<Run> runs,
        List<Mode> modes, Map<String, Gait> gaits) {

    /** A run folder: its place on the command line, from 0, and the folder's name. */
    record Run(int id, String name) {
    }

    /** A mode of real fish and its envelope: [place from head 0 to tail 1, amplitude in body lengths] pairs. */
    record Mode(String name, List<double[]> envelope) {
    }

    /** The answer of a server with these settings. */
    static SetupAnswer of(ProgramInfo program, ViewSettings settings) {
        double frequency = settings.start().gait() == null ? 1 : settings.start().gait().frequency();
        List<Run> runs = IntStream.range(0, settings.runs().size())
                .mapToObj(id -> new Run(id, RunAnswer.name(settings.runs().get(id)))).toList();
        List<Mode> modes = Arrays.stream(FishMode.values())
                .map(mode -> new Mode(mode.label(), LiveKinematics.fishEnvelope(mode, frequency))).toList();
        return new SetupAnswer(program.version(), program.scenes(), List.of(Scheme.values()), settings.start(), runs,
                modes, gaits(program.scenes(), settings.known()));
    }

    private static Map<String, Gait> gaits(List<String> scenes, Function<String, Gait> known) {
        Map<String, Gait> gaits = new LinkedHashMap<>();
        for (String scene : scenes) {
            Gait gait = known.apply(scene);
            if (gait != null) {
                gaits.put(scene, gait);
            }
        }
        return gaits;
    }
}
