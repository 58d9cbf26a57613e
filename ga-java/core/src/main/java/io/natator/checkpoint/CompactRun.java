package io.natator.checkpoint;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.base.InvalidInputException;
import io.natator.config.FileErrors;
import io.natator.config.Json;
import io.natator.config.Limits;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionState;
import io.natator.file.AtomicFile;
import java.io.ByteArrayOutputStream;
import java.io.EOFException;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.function.LongSupplier;
import java.util.zip.GZIPInputStream;
import java.util.zip.GZIPOutputStream;

/** Makes the folder of a finished run some hundred times smaller, to be kept for long. */
public final class CompactRun {

    /** The checkpoint with its population, which a run of more generations goes on from. */
    static final String WHOLE = RunWriter.CHECKPOINT + ".gz";

    private CompactRun() {
    }

    /**
     * Leaves settings, best gait, every generation's figures, the pictures and, compressed, the last population; drops the
     * single evaluations, which the same settings, seed and simulator give again.
     *
     * @throws InvalidInputException if the run is not finished
     */
    public static void compact(Path directory) {
        if (!RunReader.isFinished(directory)) {
            throw new InvalidInputException(directory + " is not a finished run");
        }
        EvolutionState state = Json.read(directory.resolve(RunWriter.CHECKPOINT), EvolutionState.class, "checkpoint");
        RunDigests.renew(directory, () -> drop(directory, state));
    }

    private static void drop(Path directory, EvolutionState state) {
        Path checkpoint = directory.resolve(RunWriter.CHECKPOINT);
        try {
            if (!state.population().isEmpty()) {
                AtomicFile.write(directory.resolve(WHOLE), compressed(Json.line(state)));
                AtomicFile.write(checkpoint,
                        Json.document(new EvolutionState(state.generation(), state.evaluations(), List.of(),
                                state.best(), state.history())));
            }
            Files.deleteIfExists(directory.resolve(RunWriter.EVALUATIONS));
        } catch (IOException e) {
            throw new UncheckedIOException("cannot remove the evaluations of " + directory + ": " + e.getMessage(), e);
        }
    }

    /** Whether a finished run was made small and has not gone on since. */
    public static boolean isCompact(Path directory) {
        return !Files.exists(directory.resolve(RunWriter.EVALUATIONS));
    }

    /**
     * What a run goes on from.
     *
     * @param state   after the last finished generation, with its population unless an older program dropped that; or null
     * @param dropped how many of the first evaluations are not recorded any more
     */
    record Last(EvolutionState state, long dropped) {
    }

    /** What the run in a folder goes on from, given the evaluations that are recorded. */
    static Last last(Path directory, List<EvaluationRecord> recorded) {
        EvolutionState state = RunReader.state(directory);
        boolean isWhole = state != null && !state.population().isEmpty();
        if (isWhole || !Files.exists(directory.resolve(WHOLE))) {
            return new Last(state, dropped(directory, recorded));
        }
        EvolutionState whole = whole(directory);
        return new Last(whole, dropped(recorded, whole::evaluations));
    }

    /** How many of the first evaluations are not recorded any more, beside those that are. */
    static long dropped(Path directory, List<EvaluationRecord> recorded) {
        return Files.exists(directory.resolve(WHOLE)) ? dropped(recorded, () -> whole(directory).evaluations()) : 0;
    }

    private static long dropped(List<EvaluationRecord> recorded, LongSupplier all) {
        return recorded.isEmpty() ? all.getAsLong() : recorded.get(0).result().id();
    }

    private static EvolutionState whole(Path directory) {
        Path file = directory.resolve(WHOLE);
        try (GZIPInputStream in = new GZIPInputStream(Files.newInputStream(file))) {
            byte[] content = in.readNBytes(Limits.FILE_BYTES);
            if (in.read() >= 0) {
                throw new IOException("larger than " + Limits.FILE_BYTES + " bytes");
            }
            return Json.parse(new String(content, StandardCharsets.UTF_8), EvolutionState.class);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("checkpoint " + file + ": " + Json.reason(e), e);
        } catch (EOFException e) {
            throw new InvalidInputException("checkpoint " + file + " ends too early", e);
        } catch (IOException e) {
            throw new InvalidInputException("checkpoint " + file + " cannot be read: " + FileErrors.reason(file, e), e);
        }
    }

    /** By gzip; the same text gives the same bytes. */
    private static byte[] compressed(String text) throws IOException {
        ByteArrayOutputStream bytes = new ByteArrayOutputStream();
        try (GZIPOutputStream out = new GZIPOutputStream(bytes)) {
            out.write(text.getBytes(StandardCharsets.UTF_8));
        }
        return bytes.toByteArray();
    }
}
