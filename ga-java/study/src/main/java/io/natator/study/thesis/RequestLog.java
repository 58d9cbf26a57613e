package io.natator.study.thesis;

import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.simulator.SimulationRequest;
import io.natator.study.KeyedLog;
import java.nio.file.Path;
import java.util.Collection;
import java.util.Set;

/** Rows of the study that each answer a request, whatever its id; a file of JSON lines, which is made with the first. */
abstract class RequestLog<T extends RequestLog.Answer> implements AutoCloseable {

    private final KeyedLog<T> rows;

    /** What a row answers. */
    interface Answer {
        /** Its id is 0. */
        SimulationRequest request();
    }

    RequestLog(Path file, Class<T> type) {
        rows = new KeyedLog<>(file, type, row -> key(row.request()));
    }

    private static String key(SimulationRequest request) {
        return Json.line(request.withId(0L));
    }

    /** The row that answers this, or null. */
    final T find(SimulationRequest request) {
        return rows.find(key(request));
    }

    final void add(T row) {
        rows.add(row);
    }

    final Collection<T> rows() {
        return rows.rows();
    }

    final int size() {
        return rows().size();
    }

    /** Drops the rows of other gaits, before any is added; returns how many. */
    final int keep(Set<Gait> gaits) {
        return rows.keep(row -> gaits.contains(row.request().gait()));
    }

    @Override
    public final void close() {
        rows.close();
    }
}
