package io.natator.study;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.Json;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.io.Writer;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.StandardOpenOption;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * The finished evaluations of a study, one per line, each written as soon as it is there. Opening it keeps those that
 * the study still asks for in exactly that form and that the same native program made; all else is dropped: lines cut
 * short when a study was killed, failures, other settings, other programs.
 */
final class StudyLog implements AutoCloseable {

    private static final Logger LOG = LoggerFactory.getLogger(StudyLog.class);

    private final String simulator;
    private final Map<String, StudyRecord> records = new LinkedHashMap<>();
    private final Writer writer;

    /**
     * Opens the log, or makes it.
     *
     * @param wanted    all evaluations of the study
     * @param simulator SHA-256 of the native program
     * @throws UncheckedIOException if that fails
     */
    StudyLog(Path file, List<StudyRun> wanted, String simulator) {
        this.simulator = simulator;
        Set<String> keys = wanted.stream().map(trial -> key(trial.request(0))).collect(Collectors.toSet());
        try {
            int dropped = Files.exists(file) ? read(file, keys) : 0;
            if (dropped > 0) {
                LOG.info("{}: {} evaluations kept, {} lines dropped", file, records.size(), dropped);
            }
            Path fresh = file.resolveSibling(file.getFileName() + ".new");
            Files.write(fresh, records.values().stream().map(Json::line).toList());
            Files.move(fresh, file, StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING);
            writer = Files.newBufferedWriter(file, StandardOpenOption.APPEND);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot open " + file + ": " + e.getMessage(), e);
        }
    }

    /** Takes over what can be kept; gives the number of lines that cannot. */
    private int read(Path file, Set<String> keys) throws IOException {
        int dropped = 0;
        for (String line : Files.readAllLines(file)) {
            StudyRecord found = parse(line);
            boolean kept = found != null && found.simulator().equals(simulator) && isFinal(found.result())
                    && keys.contains(key(found.request()));
            if (kept) {
                records.put(key(found.request()), found);
            } else {
                dropped++;
            }
        }
        return dropped;
    }

    private static StudyRecord parse(String line) {
        try {
            return Json.parse(line, StudyRecord.class);
        } catch (JsonProcessingException e) {
            return null;
        }
    }

    /** Whether another attempt would end the same. */
    private static boolean isFinal(SimulationResult result) {
        return result.status() == SimulationResult.Status.OK || result.status() == SimulationResult.Status.UNSTABLE;
    }

    /** Result of a trial, or null if it has not been carried out. */
    SimulationResult resultOf(StudyRun trial) {
        StudyRecord found = records.get(key(trial.request(0)));
        return found == null ? null : found.result();
    }

    /** Appends a finished evaluation. */
    void append(StudyRun trial, SimulationRequest request, SimulationResult result) {
        StudyRecord finished = new StudyRecord(trial.variant().name(), simulator, request, result);
        records.put(key(request), finished);
        try {
            writer.write(Json.line(finished) + "\n");
            writer.flush();
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write evaluations: " + e.getMessage(), e);
        }
    }

    /** What a request asks for, whatever its id. */
    private static String key(SimulationRequest request) {
        return Json.line(new SimulationRequest(0, request.scene(), request.gait(), request.duration(),
                request.scheme(), request.overrides(), request.perturbation()));
    }

    @Override
    public void close() {
        try {
            writer.close();
        } catch (IOException e) {
            throw new UncheckedIOException("cannot close evaluations: " + e.getMessage(), e);
        }
    }
}
