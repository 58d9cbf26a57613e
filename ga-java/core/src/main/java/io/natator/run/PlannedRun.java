package io.natator.run;

import io.natator.base.InvalidInputException;
import io.natator.checkpoint.RunReader;
import io.natator.checkpoint.RunWriter;
import io.natator.checkpoint.SceneDigest;
import io.natator.config.EvolutionSettings;
import io.natator.config.SettingsChange;
import java.nio.file.Path;

/**
 * A run that is one of many.
 *
 * @param settings  all that determines it
 * @param directory its run folder, which need not be there yet
 */
public record PlannedRun(EvolutionSettings settings, Path directory) {

    /**
     * Opens its folder, or makes it. A run of fewer generations goes on to those of the settings.
     *
     * @throws InvalidInputException if there is a run of other settings in it
     */
    public RunWriter open() {
        if (!RunReader.exists(directory)) {
            return RunWriter.create(directory, settings);
        }
        RunWriter folder = RunWriter.open(directory);
        folder.refuse(refusal(folder.settings(), settings));
        if (isShorter(folder.settings())) {
            folder.changeGenerations(settings.budget().generations());
        }
        return folder;
    }

    /**
     * Looks whether the run in its folder, finished or not, is of the settings; its backend may be another one.
     *
     * @throws InvalidInputException if it is of others
     */
    public void check() {
        if (RunReader.exists(directory)) {
            EvolutionSettings stored = RunReader.settings(directory);
            String refusal = refusal(stored, settings.withBackend(stored.budget().backend()));
            if (refusal != null) {
                throw new InvalidInputException(refusal);
            }
        }
    }

    /**
     * Looks whether the run in its folder, where it is to go on, has the scene that it was begun with.
     *
     * @throws InvalidInputException if that was changed
     */
    public void checkScene(Path simulator) throws InterruptedException {
        if (RunReader.exists(directory) && !isFinished()) {
            SceneDigest.check(directory, settings, SceneDigest.of(settings, simulator));
        }
    }

    /** Why a run cannot go on by settings; null if it can. */
    private String refusal(EvolutionSettings stored, EvolutionSettings wanted) {
        EvolutionSettings extended = isShorter(stored) ? stored.withGenerations(wanted.budget().generations()) : stored;
        return extended.equals(wanted) ? null
                : directory + " was begun with other settings: " + SettingsChange.between(extended, wanted)
                        + "; choose another --output-dir, or the options that it was begun with";
    }

    /** Whether it has come to its end; one of fewer generations than this has not. */
    public boolean isFinished() {
        return RunReader.isFinished(directory) && !isShorter(RunReader.settings(directory));
    }

    private boolean isShorter(EvolutionSettings stored) {
        return stored.budget().generations() < settings.budget().generations();
    }

    /** How many of its evaluations are recorded. */
    public long recorded() {
        return RunReader.exists(directory) ? RunReader.recorded(directory).end() : 0;
    }
}
