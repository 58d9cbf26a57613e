package io.natator.study.thesis;

import io.natator.checkpoint.StoredRun;
import io.natator.config.EvolutionSettings;
import io.natator.run.PlannedRun;

/**
 * One evolution of the study.
 *
 * @param creature of the thesis, 1 to 4
 * @param water    in which it evolves
 * @param seed     of the evolution
 * @param plan     its settings and run folder
 */
public record EvolvedRun(int creature, Water water, long seed, PlannedRun plan) {

    /** As its folder has them, once it is begun. */
    EvolutionSettings storedSettings() {
        return StoredRun.settings(plan.directory());
    }
}
