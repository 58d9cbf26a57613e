package io.natator.checkpoint;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.body.Swimmer;
import io.natator.encoding.Gait;
import java.nio.file.Path;

/** What was measured of a run's winner afterwards. It can be measured again, so a damaged file is but warned of. */
interface AboutWinner {

    /** The winner's gait. */
    Gait gait();

    /** The winner's body, or null for the scene's own. */
    JsonNode body();

    /** What a file of a run folder tells of its winner; null if there is none, or it is about another swimmer. */
    static <T extends AboutWinner> T in(Path run, String name, Class<T> type, Swimmer best) {
        T found = RunReader.readable(run, name, type);
        return found == null || !new Swimmer(found.gait(), found.body()).equals(best) ? null : found;
    }
}
