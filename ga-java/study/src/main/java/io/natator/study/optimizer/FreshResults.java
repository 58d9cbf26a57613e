package io.natator.study.optimizer;

import io.natator.checkpoint.FreshRuns;
import io.natator.file.JsonLines;
import io.natator.study.KeyedLog;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/**
 * What gaits of the runs on one scene do from fresh starts, beside what the runs tell of their winners:
 * {@code SCENE-again.jsonl} and {@code SCENE-ranks.jsonl}. Rows can be added by several threads.
 */
final class FreshResults implements AutoCloseable {

    private final Path gaitFile;
    private final Path rankFile;
    private final Map<String, FreshGait> gaits = new HashMap<>();
    private final Map<String, RankedGeneration> ranks = new HashMap<>();
    private KeyedLog<FreshGait> gaitLog;
    private KeyedLog<RankedGeneration> rankLog;

    /**
     * Reads the files, if they are there.
     *
     * @throws io.natator.config.InvalidInputException if one is damaged
     */
    FreshResults(Path directory, String scene) {
        gaitFile = directory.resolve(scene + "-again.jsonl");
        rankFile = directory.resolve(scene + "-ranks.jsonl");
        JsonLines.read(gaitFile, FreshGait.class).forEach(row -> gaits.put(key(row), row));
        JsonLines.read(rankFile, RankedGeneration.class).forEach(row -> ranks.put(key(row), row));
    }

    private static String key(FreshGait row) {
        return row.optimizer() + " " + row.seed() + " " + row.genes();
    }

    private static String key(RankedGeneration row) {
        return row.optimizer() + " " + row.seed();
    }

    synchronized void add(FreshGait row) {
        gaitLog = gaitLog != null ? gaitLog : new KeyedLog<>(gaitFile, FreshGait.class, FreshResults::key);
        gaitLog.add(row);
        gaits.put(key(row), row);
    }

    synchronized void add(RankedGeneration row) {
        rankLog = rankLog != null ? rankLog : new KeyedLog<>(rankFile, RankedGeneration.class, FreshResults::key);
        rankLog.add(row);
        ranks.put(key(row), row);
    }

    /** What a gait of a run is worth by fresh starts; NaN if that is not known. */
    synchronized double worth(OptimizerRun run, List<Double> genes) {
        RunSummary summary = run.summary();
        if (summary.fresh() != null && genes.equals(summary.best().genes())) {
            return summary.fresh().again();
        }
        FreshGait found = found(run, genes);
        return found == null ? Double.NaN : run.settings().judge().of(found.runs());
    }

    private FreshGait found(OptimizerRun run, List<Double> genes) {
        return gaits.get(key(new FreshGait(run.variant().label(), run.settings().seed(), genes, List.of())));
    }

    /** The selection loss of a run's winner; null if that is not known, or tells nothing. */
    synchronized Double loss(OptimizerRun run) {
        RunSummary summary = run.summary();
        if (summary.fresh() != null) {
            return summary.fresh().selectionLoss();
        }
        FreshGait found = summary.best() == null ? null : found(run, summary.best().genes());
        return found == null ? null : FreshRuns.loss(run.settings().judge(), summary.selected(), found.runs());
    }

    /** How well a run's last generation was ranked; null if that is not known. */
    synchronized RankedGeneration rank(OptimizerRun run) {
        return ranks.get(key(new RankedGeneration(run.variant().label(), run.settings().seed(), 0, 0, null)));
    }

    /** Closes the files; what they hold stays known. */
    @Override
    public synchronized void close() {
        if (gaitLog != null) {
            gaitLog.close();
            gaitLog = null;
        }
        if (rankLog != null) {
            rankLog.close();
            rankLog = null;
        }
    }
}
