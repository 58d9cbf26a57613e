package io.natator.study.optimizer;

import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.StoredRun;
import io.natator.config.EvolutionSettings;
import io.natator.config.InvalidInputException;
import java.nio.file.Path;

/**
 * One run of the study.
 *
 * @param scene      short name of the scene
 * @param contestant what searches
 * @param settings   all that determines the run
 * @param directory  its run folder
 */
record OptimizerRun(String scene, Contestant contestant, EvolutionSettings settings, Path directory) {

    /**
     * Opens its folder, or makes it.
     *
     * @throws InvalidInputException if there is a run of other settings in it
     */
    RunFolder open() {
        if (!StoredRun.exists(directory)) {
            return RunFolder.create(directory, settings);
        }
        RunFolder folder = RunFolder.open(directory);
        if (!folder.settings().equals(settings)) {
            folder.close();
            throw new InvalidInputException(directory + " was begun with other settings; choose another --output-dir, "
                    + "or the options that it was begun with");
        }
        return folder;
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
