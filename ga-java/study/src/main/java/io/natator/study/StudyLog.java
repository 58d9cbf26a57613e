package io.natator.study;

import io.natator.config.Json;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import java.nio.file.Path;
import java.util.List;
import java.util.Set;
import java.util.stream.Collectors;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * The finished evaluations of a study, one per line. Opening it keeps those that the study still asks for in exactly that
 * form and that the same native program made; all else is dropped: failures, other settings, other programs.
 */
final class StudyLog implements AutoCloseable {

    private static final Logger LOG = LoggerFactory.getLogger(StudyLog.class);

    private final String simulator;
    private final KeyedLog<StudyRecord> records;

    /**
     * Opens the log.
     *
     * @param wanted    all evaluations of the study
     * @param simulator SHA-256 of the native program
     * @throws io.natator.config.InvalidInputException if it is damaged
     */
    StudyLog(Path file, List<StudyRun> wanted, String simulator) {
        this.simulator = simulator;
        this.records = new KeyedLog<>(file, StudyRecord.class, row -> key(row.request()));
        Set<String> keys = wanted.stream().map(run -> key(run.request(0))).collect(Collectors.toSet());
        int dropped = records.keep(row -> row.simulator().equals(simulator) && isFinal(row.result())
                && keys.contains(key(row.request())));
        if (dropped > 0) {
            LOG.info("{}: {} evaluations kept, {} dropped", file, records.rows().size(), dropped);
        }
    }

    /** Whether another attempt would end the same. */
    private static boolean isFinal(SimulationResult result) {
        return result.status() == SimulationResult.Status.OK || result.status() == SimulationResult.Status.UNSTABLE;
    }

    /** Result of a run, or null if it has not been carried out. */
    SimulationResult resultOf(StudyRun run) {
        StudyRecord found = records.find(key(run.request(0)));
        return found == null ? null : found.result();
    }

    /** Appends a finished evaluation. */
    void append(StudyRun run, SimulationRequest request, SimulationResult result) {
        records.add(new StudyRecord(run.variant().name(), simulator, request, result));
    }

    /** What a request asks for, whatever its id. */
    private static String key(SimulationRequest request) {
        return Json.line(request.withId(0L));
    }

    @Override
    public void close() {
        records.close();
    }
}
