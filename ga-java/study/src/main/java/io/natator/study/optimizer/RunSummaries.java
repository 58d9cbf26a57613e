package io.natator.study.optimizer;

import io.natator.checkpoint.RunFolder;
import io.natator.config.EvolutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.SettingsChange;
import io.natator.file.JsonLines;
import io.natator.study.KeyedLog;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;

/** The finished runs on one scene whose folders need not be there any more; a file {@code SCENE.jsonl}, a run a line. */
final class RunSummaries {

    private final Path file;
    private final Map<String, RunSummary> rows = new HashMap<>();

    /**
     * Reads the file, if it is there.
     *
     * @throws InvalidInputException if it is damaged
     */
    RunSummaries(Path directory, String scene) {
        this.file = directory.resolve(scene + ".jsonl");
        JsonLines.read(file, RunSummary.class).forEach(row -> rows.put(key(row), row));
    }

    private static String key(RunSummary row) {
        return key(row.optimizer(), row.settings());
    }

    private static String key(String optimizer, EvolutionSettings settings) {
        return optimizer + " " + settings.seed();
    }

    /**
     * What is kept of a run; null if nothing is, or not its whole curve.
     *
     * @throws InvalidInputException if that is of other settings
     */
    RunSummary find(OptimizerVariant variant, EvolutionSettings settings) {
        RunSummary found = rows.get(key(variant.label(), settings));
        if (found == null || found.improvements() == null) {
            return null;
        }
        if (!found.settings().equals(settings)) {
            throw new InvalidInputException(file + ": " + variant.label() + ", seed " + settings.seed()
                    + " was begun with other settings: " + SettingsChange.between(found.settings(), settings)
                    + "; choose another --output-dir, or the options that it was begun with");
        }
        return found;
    }

    /** Keeps finished runs, and removes their folders, which it has read. */
    void keep(List<OptimizerRun> finished) {
        List<OptimizerRun> fresh = finished.stream().filter(run -> rows.get(key(run.summary())) != run.summary()).toList();
        Set<String> keys = fresh.stream().map(run -> key(run.summary())).collect(Collectors.toSet());
        try (KeyedLog<RunSummary> log = new KeyedLog<>(file, RunSummary.class, RunSummaries::key)) {
            log.keep(row -> !keys.contains(key(row)));
            for (OptimizerRun run : fresh) {
                log.add(run.summary());
                rows.put(key(run.summary()), run.summary());
            }
        }
        finished.forEach(run -> delete(run.directory()));
    }

    /** Removes a run folder, and the folders above that are empty then. */
    private void delete(Path folder) {
        RunFolder.delete(folder);
        try {
            for (Path above = folder.getParent(); !above.equals(file.getParent()) && !RunFolder.isOccupied(above);
                    above = above.getParent()) {
                Files.deleteIfExists(above);
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot remove the folders above " + folder + ": " + e.getMessage(), e);
        }
    }
}
