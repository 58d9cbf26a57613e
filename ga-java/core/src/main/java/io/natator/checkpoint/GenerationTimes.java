package io.natator.checkpoint;

import io.natator.evolution.EvolutionState;
import io.natator.evolution.GenerationSummary;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.Locale;

/** {@code timings.csv}: how long each generation took, in seconds of a monotonic clock. */
final class GenerationTimes {

    private static final double NANOSECONDS = 1e9;

    private final Path file;
    private long started = System.nanoTime();

    GenerationTimes(Path file) {
        this.file = file;
    }

    void start() {
        started = System.nanoTime();
    }

    void append(EvolutionState state) {
        GenerationSummary last = state.history().get(state.history().size() - 1);
        double seconds = (System.nanoTime() - started) / NANOSECONDS;
        String row = String.format(Locale.ROOT, "%d,%d,%.3f%n", last.generation(), last.evaluations(), seconds);
        try {
            if (!Files.exists(file)) {
                row = "generation,evaluations,seconds\n" + row;
            }
            Files.writeString(file, row, StandardOpenOption.CREATE, StandardOpenOption.APPEND);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + file + ": " + e.getMessage(), e);
        }
    }
}
