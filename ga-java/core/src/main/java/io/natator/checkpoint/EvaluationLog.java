package io.natator.checkpoint;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.evolution.EvaluationRecord;
import java.io.IOException;
import java.io.RandomAccessFile;
import java.io.UncheckedIOException;
import java.nio.channels.FileLock;
import java.nio.channels.OverlappingFileLockException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/**
 * The simulations of a run, one per line in the order of their ids, handed to the operating system one by one. A line
 * that was cut short when the run was killed is dropped at the next opening. Holds a lock on the file, so that two
 * processes cannot write the same run.
 */
final class EvaluationLog implements AutoCloseable {

    private final Path file;
    /** No channel: that would be closed by an interrupt of the thread that writes. */
    private final RandomAccessFile content;
    private final List<EvaluationRecord> records = new ArrayList<>();
    /** Where each of them begins in the file. */
    private final List<Integer> starts = new ArrayList<>();
    private long size;

    /**
     * Opens the log, or makes it.
     *
     * @throws InvalidInputException if another process has it open, or a line of it cannot be read
     */
    EvaluationLog(Path file) {
        this.file = file;
        try {
            content = new RandomAccessFile(file.toFile(), "rw");
        } catch (IOException e) {
            throw new UncheckedIOException("cannot open " + AtomicFile.reason(file, e), e);
        }
        try {
            lock();
            readWholeLines();
        } catch (IOException e) {
            close();
            throw new UncheckedIOException("cannot read " + AtomicFile.reason(file, e), e);
        } catch (InvalidInputException e) {
            close();
            throw e;
        }
    }

    private void lock() throws IOException {
        FileLock lock;
        try {
            lock = content.getChannel().tryLock();
        } catch (OverlappingFileLockException e) {
            lock = null;
        }
        if (lock == null) {
            throw new InvalidInputException(file.getParent() + " is in use by another run");
        }
    }

    private void readWholeLines() throws IOException {
        byte[] bytes = new byte[(int) content.length()];
        content.readFully(bytes);
        int end = 0;
        for (int i = 0; i < bytes.length; i++) {
            if (bytes[i] == '\n') {
                starts.add(end);
                records.add(parse(file, records.size() + 1, new String(bytes, end, i - end, StandardCharsets.UTF_8)));
                end = i + 1;
            }
        }
        content.setLength(end);
        content.seek(end);
        size = records.size();
    }

    private static EvaluationRecord parse(Path file, int number, String line) {
        try {
            return Json.parse(line, EvaluationRecord.class);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException(file + ", line " + number + ": " + Json.reason(e), e);
        }
    }

    /** The whole lines of a log, which another process may be writing. */
    static List<EvaluationRecord> read(Path file) {
        try {
            String text = Files.exists(file) ? Files.readString(file) : "";
            List<EvaluationRecord> found = new ArrayList<>();
            for (int start = 0, end; (end = text.indexOf('\n', start)) >= 0; start = end + 1) {
                found.add(parse(file, found.size() + 1, text.substring(start, end)));
            }
            return found;
        } catch (IOException e) {
            throw new InvalidInputException("cannot read " + AtomicFile.reason(file, e), e);
        }
    }

    /** The simulations that were in the file when it was opened. */
    List<EvaluationRecord> records() {
        return records;
    }

    /** Forgets a simulation that was in the file when it was opened, and all after it. */
    void dropFrom(int first) {
        try {
            content.setLength(starts.get(first));
            content.seek(starts.get(first));
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + AtomicFile.reason(file, e), e);
        }
        records.subList(first, records.size()).clear();
        size = first;
    }

    /** Forces all that was appended to the disk, so that no checkpoint can be there without it after a power cut. */
    void force() {
        try {
            content.getFD().sync();
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + AtomicFile.reason(file, e), e);
        }
    }

    /** Appends a simulation, unless it is already there. */
    void append(EvaluationRecord evaluation) {
        if (evaluation.result().id() < size) {
            return;
        }
        try {
            content.write((Json.line(evaluation) + "\n").getBytes(StandardCharsets.UTF_8));
            size++;
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + AtomicFile.reason(file, e), e);
        }
    }

    @Override
    public void close() {
        try {
            content.close();
        } catch (IOException e) {
            throw new UncheckedIOException("cannot close " + AtomicFile.reason(file, e), e);
        }
    }
}
