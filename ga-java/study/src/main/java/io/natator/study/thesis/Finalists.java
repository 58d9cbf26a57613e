package io.natator.study.thesis;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.checkpoint.JudgedGait;
import io.natator.checkpoint.JudgedGaits;
import io.natator.checkpoint.StoredRun;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.Recorded;
import io.natator.file.AtomicFile;
import io.natator.simulator.SimulationResult;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.stream.Stream;

/**
 * The gaits of a finished evolution that are worth being judged again, the best first; {@code finalists.json} in its run
 * folder, since the evaluations that they are taken from are too large to be kept.
 *
 * @param gaits      with what they were worth to the evolution
 * @param generation after which they were taken; null in files of older programs: the last
 */
public record Finalists(@JsonProperty(required = true) List<Finalist> gaits,
        @JsonInclude(JsonInclude.Include.NON_NULL) Integer generation) {

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

        /** Whether it was unstable in any of these runs. */
        private boolean isUnstable(List<EvaluationRecord> since) {
            return since.stream().anyMatch(one -> gait.equals(one.gait()) && one.result().status() == SimulationResult.Status.UNSTABLE);
        }

        /** The same gait by these runs, too, of those that are its own. */
        private Finalist with(List<EvaluationRecord> since) {
            List<EvaluationRecord> own = since.stream().filter(one -> gait.equals(one.gait())).toList();
            double sum = own.stream().mapToDouble(one -> one.result().score()).sum();
            int all = runs + own.size();
            return new Finalist(gait, (score * runs + sum) / all, all);
        }
    }

    /**
     * Takes them from a finished run, if that has not been done: of all its gaits, or, where its first evaluations are gone, of
     * those taken before and all since.
     *
     * @throws InvalidInputException if they are neither there nor to be had, since the evaluations are gone
     */
    public static void keep(Path run) {
        Finalists before = Files.exists(run.resolve(FILE)) ? of(run) : null;
        int generation = StoredRun.state(run).generation();
        if (before != null && Objects.equals(before.generation, generation)) {
            return;
        }
        Recorded recorded = StoredRun.recorded(run);
        if (before != null && recorded.rows().isEmpty()) {
            return;
        }
        boolean isWhole = before == null || recorded.first() == 0;
        List<EvaluationRecord> since = isWhole || before.generation == null ? recorded.rows()
                : recorded.rows().stream().filter(one -> one.generation() > before.generation).toList();
        List<Finalist> gaits = JudgedGaits.ranked(StoredRun.settings(run), since).stream().map(Finalist::of).toList();
        gaits = isWhole ? gaits : joined(before.gaits.stream().filter(one -> !one.isUnstable(since))
                .map(one -> one.with(since)).toList(), gaits);
        if (gaits.isEmpty()) {
            throw new InvalidInputException(run + " has no evaluations any more and no " + FILE + "; delete it to evolve it again");
        }
        AtomicFile.write(run.resolve(FILE), Json.document(new Finalists(gaits.stream().limit(COUNT).toList(), generation)));
    }

    /** Those that were known before, and the others, the best first. */
    private static List<Finalist> joined(List<Finalist> known, List<Finalist> others) {
        Map<Gait, Finalist> all = new LinkedHashMap<>();
        Stream.concat(known.stream(), others.stream()).forEach(one -> all.putIfAbsent(one.gait, one));
        return all.values().stream().sorted(Comparator.comparingDouble(Finalist::score).reversed()).toList();
    }

    /** Those of a run that were kept. */
    static Finalists of(Path run) {
        return Json.read(run.resolve(FILE), Finalists.class, "finalists");
    }
}
