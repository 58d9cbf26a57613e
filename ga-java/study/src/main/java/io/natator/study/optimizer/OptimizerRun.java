package io.natator.study.optimizer;

import io.natator.config.EvolutionSettings;
import io.natator.run.PlannedRun;
import java.nio.file.Path;

/**
 * One run of the study.
 *
 * @param scene      short name of the scene
 * @param variant    what searches
 * @param settings   all that determines the run
 * @param directory  its run folder
 * @param summary    what is kept of it in {@code SCENE.jsonl}; null if it is not there
 */
record OptimizerRun(String scene, OptimizerVariant variant, EvolutionSettings settings, Path directory,
        RunSummary summary) {

    /** Itself as one of many runs. */
    PlannedRun plan() {
        return new PlannedRun(settings, directory);
    }

    boolean isFinished() {
        return summary != null || plan().isFinished();
    }

    /** How many of its evaluations are recorded. */
    long recorded() {
        return summary != null ? summary.evaluations() : plan().recorded();
    }

    /** The same run with what is kept of it once it is finished. */
    OptimizerRun summarised() {
        return summary != null ? this
                : new OptimizerRun(scene, variant, settings, directory, RunSummary.of(variant.label(), directory));
    }
}
