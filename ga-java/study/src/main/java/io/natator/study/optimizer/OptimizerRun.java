package io.natator.study.optimizer;

import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.StoredRun;
import io.natator.config.EvolutionSettings;
import io.natator.run.PlannedRun;
import java.nio.file.Path;

/**
 * One run of the study.
 *
 * @param scene      short name of the scene
 * @param variant what searches
 * @param settings   all that determines the run
 * @param directory  its run folder
 */
record OptimizerRun(String scene, OptimizerVariant variant, EvolutionSettings settings, Path directory) {

    /** Itself as one of many runs. */
    PlannedRun plan() {
        return new PlannedRun(settings, directory);
    }

    /** Best fitness after each evaluation. */
    double[] curve() {
        return StoredRun.bestFitness(StoredRun.evaluations(directory));
    }

    /** What the finished run's best gait does in vacuum, in scene units; NaN if that is not known. */
    double vacuumDistance() {
        BestGait best = StoredRun.in(directory).best();
        return best == null || best.vacuum() == null || best.vacuum().distance() == null ? Double.NaN
                : best.vacuum().distance();
    }
}
