package io.natator.checkpoint;

import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.evolution.EvolutionState;
import io.natator.file.AtomicFile;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

/** Makes the folder of a finished run some hundred times smaller, to be kept for long. */
public final class CompactRun {

    private CompactRun() {
    }

    /**
     * Leaves settings, best gait, every generation's figures and the pictures; drops the single evaluations and the last
     * population, which the same settings, seed and simulator give again.
     *
     * @throws InvalidInputException if the run is not finished
     */
    public static void compact(Path directory) {
        if (!StoredRun.isFinished(directory)) {
            throw new InvalidInputException(directory + " is not a finished run");
        }
        Path checkpoint = directory.resolve(RunFolder.CHECKPOINT);
        EvolutionState state = Json.read(checkpoint, EvolutionState.class, "checkpoint");
        AtomicFile.write(checkpoint, Json.document(new EvolutionState(state.generation(), state.evaluations(), List.of(),
                state.best(), state.history())));
        try {
            Files.deleteIfExists(directory.resolve(RunFolder.EVALUATIONS));
        } catch (IOException e) {
            throw new UncheckedIOException("cannot remove the evaluations of " + directory + ": " + e.getMessage(), e);
        }
    }
}
