package io.natator.study.thesis;

import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.checkpoint.JudgedGait;
import io.natator.checkpoint.StoredRun;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.file.AtomicFile;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

/**
 * The gaits of a finished evolution that are worth being judged again, the best first; {@code finalists.json} in its run
 * folder, since the evaluations that they are taken from are too large to be kept.
 *
 * @param gaits with what they were worth to the evolution
 */
public record Finalists(@JsonProperty(required = true) List<Finalist> gaits) {

    private static final String FILE = "finalists.json";
    static final int COUNT = 8;

    /**
     * One of them.
     *
     * @param gait  of all actuators
     * @param score worth, as the evolution judged
     * @param runs  that the worth rests on
     */
    public record Finalist(@JsonProperty(required = true) Gait gait, double score, int runs) {

        private static Finalist of(JudgedGait judged) {
            return new Finalist(judged.swimmer().gait(), judged.score(), judged.runs());
        }
    }

    /**
     * Takes them from a finished run, if that has not been done.
     *
     * @throws InvalidInputException if they are neither there nor to be had, since the evaluations are gone
     */
    public static void keep(Path run) {
        if (Files.exists(run.resolve(FILE))) {
            return;
        }
        List<JudgedGait> gaits = StoredRun.in(run).gaits();
        if (gaits.isEmpty()) {
            throw new InvalidInputException(run + " has no evaluations any more and no " + FILE + "; delete it to evolve it again");
        }
        AtomicFile.write(run.resolve(FILE), Json.document(new Finalists(gaits.stream().limit(COUNT).map(Finalist::of).toList())));
    }

    /** Those of a run that were kept. */
    static Finalists of(Path run) {
        return Json.read(run.resolve(FILE), Finalists.class, "finalists");
    }
}
