package io.natator.checkpoint;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.evolution.EvaluationRecord;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.ByteBuffer;
import java.nio.channels.Channels;
import java.nio.channels.FileChannel;
import java.nio.channels.FileLock;
import java.nio.channels.OverlappingFileLockException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.HashMap;
import java.util.Map;

/**
 * The simulations of a run, one per line in the order of their ids, handed to the operating system one by one. A line
 * that was cut short when the run was killed is dropped at the next opening. Holds a lock on the file, so that two
 * processes cannot write the same run.
 */
final class EvaluationLog implements AutoCloseable {

    private final Path file;
    private final FileChannel channel;
    private final Map<Long, EvaluationRecord> records = new HashMap<>();
    private long nextId;

    /**
     * Opens the log, or makes it.
     *
     * @throws InvalidInputException if another process has it open
     */
    EvaluationLog(Path file) {
        this.file = file;
        try {
            channel = FileChannel.open(file, StandardOpenOption.CREATE, StandardOpenOption.READ,
                    StandardOpenOption.WRITE);
            lock();
            readWholeLines();
        } catch (IOException e) {
            throw new UncheckedIOException("cannot open " + file + ": " + e.getMessage(), e);
        }
    }

    private void lock() throws IOException {
        FileLock lock;
        try {
            lock = channel.tryLock();
        } catch (OverlappingFileLockException e) {
            lock = null;
        }
        if (lock == null) {
            channel.close();
            throw new InvalidInputException(file.getParent() + " is in use by another run");
        }
    }

    private void readWholeLines() throws IOException {
        byte[] bytes = Channels.newInputStream(channel).readAllBytes();
        int end = 0;
        for (int i = 0; i < bytes.length; i++) {
            if (bytes[i] == '\n') {
                String line = new String(bytes, end, i - end, StandardCharsets.UTF_8);
                try {
                    records.put(nextId, Json.parse(line, EvaluationRecord.class));
                } catch (JsonProcessingException e) {
                    throw new InvalidInputException(file + ", line " + (nextId + 1) + ": " + Json.reason(e), e);
                }
                nextId++;
                end = i + 1;
            }
        }
        channel.truncate(end);
        channel.position(end);
    }

    /** The simulations from an id on that were in the file when it was opened, by id. */
    Map<Long, EvaluationRecord> from(long firstId) {
        Map<Long, EvaluationRecord> later = new HashMap<>(records);
        later.keySet().removeIf(id -> id < firstId);
        return later;
    }

    /** How many simulations are in the log. */
    long size() {
        return nextId;
    }

    /** Forces all that was appended to the disk, so that no checkpoint can be there without it after a power cut. */
    void force() {
        try {
            channel.force(false);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + file + ": " + e.getMessage(), e);
        }
    }

    /** Appends a simulation, unless it is already there. */
    void append(EvaluationRecord evaluation) {
        if (evaluation.result().id() < nextId) {
            return;
        }
        try {
            ByteBuffer bytes = ByteBuffer.wrap((Json.line(evaluation) + "\n").getBytes(StandardCharsets.UTF_8));
            while (bytes.hasRemaining()) {
                channel.write(bytes);
            }
            nextId++;
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + file + ": " + e.getMessage(), e);
        }
    }

    @Override
    public void close() {
        try {
            channel.close();
        } catch (IOException e) {
            throw new UncheckedIOException("cannot close " + file + ": " + e.getMessage(), e);
        }
    }
}
