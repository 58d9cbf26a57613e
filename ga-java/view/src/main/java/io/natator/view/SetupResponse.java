package io.natator.view;

import io.natator.config.Scheme;
import io.natator.encoding.Gait;
import io.natator.process.ProgramInfo;
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
 * @param gaits   known gaits by the scene that they are for
 */
record SetupResponse(String version, List<String> scenes, List<Scheme> schemes, InitialScene start, List<Run> runs,
        Map<String, Gait> gaits) {

    /** A run folder: its place on the command line, from 0, and the folder's name. */
    record Run(int id, String name) {
    }

    /** The answer of a server with these settings. */
    static SetupResponse of(ProgramInfo program, ViewSettings settings) {
        List<Run> runs = IntStream.range(0, settings.runs().size())
                .mapToObj(id -> new Run(id, RunResponse.name(settings.runs().get(id)))).toList();
        return new SetupResponse(program.version(), program.scenes(), List.of(Scheme.values()), settings.start(), runs,
                gaits(program.scenes(), settings.known()));
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
