package io.natator.checkpoint;

import io.natator.base.Numbers;
import io.natator.body.Genome;
import io.natator.config.EvolutionSettings;
import io.natator.config.SettingsChange;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.RecordedEvaluations;
import java.nio.file.Path;
import java.util.stream.Stream;

/** What may be wrong with the files of a run, so that it cannot go on by them. */
final class RunDamage {

    private RunDamage() {
    }

    /** Which settings were edited since the run computed by them, in one line; null if none were, or none are recorded. */
    static String editedSettings(Path directory, EvolutionSettings settings) {
        RunReader.Origin before = RunReader.origin(directory);
        String change = before == null || before.settings() == null ? ""
                : SettingsChange.withinRun(before.settings(), settings);
        return change.isEmpty() ? null
                : directory.resolve(RunWriter.CONFIG) + " was edited after the run was begun: " + change
                        + "; expected the settings that it was begun with, or a new run";
    }

    /**
     * How many evaluations of a run are lost, in one line; null if none are. They are on the disk before the checkpoint that
     * counts them, so there are never fewer of a sound run, also while it is written.
     */
    static String lostEvaluations(Path directory, EvolutionState checkpoint, long recorded) {
        if (checkpoint != null && checkpoint.evaluations() < 0) {
            return directory + " is damaged: evaluations of " + RunWriter.CHECKPOINT + " is " + checkpoint.evaluations()
                    + "; expected at least 0";
        }
        return checkpoint == null || recorded >= checkpoint.evaluations() ? null
                : directory + " is damaged: " + RunWriter.EVALUATIONS
                        + " has " + Numbers.count(recorded, "whole line") + "; expected at least the "
                        + checkpoint.evaluations() + " of " + RunWriter.CHECKPOINT;
    }

    /** Which evaluation stands where another should, in one line; null if none does. */
    static String misplacedEvaluation(Path directory, RecordedEvaluations recorded) {
        for (int i = 0; i < recorded.rows().size(); i++) {
            long id = recorded.rows().get(i).result().id();
            if (id != recorded.first() + i) {
                return directory + " is damaged: " + RunWriter.EVALUATIONS + ", line " + (i + 1) + ": id is " + id
                        + "; expected " + (recorded.first() + i);
            }
        }
        return null;
    }

    /** Which genes of a checkpoint stand for nothing, in one line; null if none do. */
    static String genes(Path directory, Genome genome, EvolutionState checkpoint) {
        if (checkpoint == null) {
            return null;
        }
        try {
            Stream.concat(checkpoint.population().stream(), Stream.ofNullable(checkpoint.best()))
                    .forEach(one -> genome.decode(one.genes()));
            return null;
        } catch (IllegalArgumentException e) {
            return directory + " is damaged: genes of " + RunWriter.CHECKPOINT + ": " + e.getMessage();
        }
    }
}
