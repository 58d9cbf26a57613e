package io.natator.file;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.base.InvalidInputException;
import io.natator.config.FileErrors;
import io.natator.config.Json;
import io.natator.config.Limits;
import java.io.ByteArrayOutputStream;
import java.io.FileInputStream;
import java.io.IOException;
import java.io.InputStream;
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
 * Rows in a file, one JSON value a line, each handed to the operating system as soon as it is appended. A last line that
 * was cut short when its writer was killed is no row; the next row takes its place. While one process writes, no other
 * can. A file that was made for no row is removed again.
 */
public final class JsonLines<T> implements AutoCloseable {

    private final Path file;
    private final Class<T> type;
    private final List<T> rows = new ArrayList<>();
    /** Where each row that was in the file begins, and where the last one ends: bytes. */
    private final List<Long> starts = new ArrayList<>(List.of(0L));
    /** Bytes of the file when it was read, with what was cut short. */
    private long length;
    private int size;
    /** Whether it was not there before it was opened for writing. */
    private boolean isNew;
    /** Null until it is written. No channel: that would be closed by an interrupt of the thread that writes. */
    private RandomAccessFile content;

    private JsonLines(Path file, Class<T> type) {
        this.file = file;
        this.type = type;
    }

    /**
     * Reads a file, if it is there. It is opened for writing, or made, when the first row is appended.
     *
     * @throws InvalidInputException if it cannot be read, or a whole line of it is no such row
     */
    public static <T> JsonLines<T> of(Path file, Class<T> type) {
        JsonLines<T> lines = new JsonLines<>(file, type);
        FileErrors.checkRegular(file);
        try (InputStream in = Files.exists(file) ? Files.newInputStream(file) : InputStream.nullInputStream()) {
            lines.parse(in);
        } catch (IOException e) {
            throw new InvalidInputException("cannot read " + AtomicFile.reason(file, e), e);
        }
        return lines;
    }

    /**
     * Opens a file for writing at once, or makes it.
     *
     * @throws InvalidInputException if it is no file, another process writes it, or a whole line of it is no such row
     */
    public static <T> JsonLines<T> locked(Path file, Class<T> type) {
        JsonLines<T> lines = new JsonLines<>(file, type);
        FileErrors.checkRegular(file);
        try {
            lines.open();
            lines.parse(new FileInputStream(lines.content.getFD()));
            lines.dropFrom(lines.size);
        } catch (IOException e) {
            lines.close();
            throw new UncheckedIOException("cannot open " + AtomicFile.reason(file, e), e);
        } catch (InvalidInputException e) {
            lines.close();
            throw e;
        }
        return lines;
    }

    /**
     * The rows of a file, which another process may be writing; none if it is not there.
     *
     * @throws InvalidInputException if it cannot be read, or a whole line of it is no such row
     */
    public static <T> List<T> read(Path file, Class<T> type) {
        return of(file, type).rows;
    }

    /** Line by line, as a whole file may be more than an array can hold. */
    private void parse(InputStream in) throws IOException {
        byte[] bytes = new byte[1 << 16];
        ByteArrayOutputStream line = new ByteArrayOutputStream();
        length = 0;
        for (int count = in.read(bytes); count >= 0; count = in.read(bytes)) {
            int start = 0;
            for (int i = 0; i < count; i++) {
                if (bytes[i] == '\n') {
                    append(line, bytes, start, i);
                    rows.add(parse(line.toString(StandardCharsets.UTF_8)));
                    line.reset();
                    start = i + 1;
                    starts.add(length + start);
                }
            }
            append(line, bytes, start, count);
            length += count;
        }
        size = rows.size();
    }

    private void append(ByteArrayOutputStream line, byte[] bytes, int start, int end) {
        if (line.size() + end - start > Limits.LINE_BYTES) {
            throw new InvalidInputException(
                    file + ", line " + (rows.size() + 1) + " is longer than " + Limits.LINE_BYTES + " bytes");
        }
        line.write(bytes, start, end - start);
    }

    private T parse(String line) {
        try {
            return Json.parse(line, type);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException(file + ", line " + (rows.size() + 1) + ": " + Json.reasonInLine(e), e);
        }
    }

    private void open() throws IOException {
        isNew = !Files.exists(file);
        RandomAccessFile opened = new RandomAccessFile(file.toFile(), "rw");
        FileLock lock;
        try {
            lock = opened.getChannel().tryLock();
        } catch (OverlappingFileLockException e) {
            lock = null;
        }
        if (lock == null || !Files.exists(file)) {  // who had it locked may have removed it
            opened.close();
            throw new InvalidInputException(file + " is in use by another run");
        }
        content = opened;
    }

    /** Opens for writing what was only read so far. */
    private void reopen() throws IOException {
        Files.createDirectories(file.toAbsolutePath().getParent());
        openUnchanged();
        dropFrom(size);
    }

    /** Opens for writing what nobody has changed since it was read. */
    private void openUnchanged() throws IOException {
        open();
        if (content.length() != length) {
            content.close();
            content = null;
            throw new InvalidInputException(file + " was changed by another run meanwhile");
        }
    }

    /** The rows that were in the file when it was opened. */
    public List<T> rows() {
        return rows;
    }

    /** How many rows are in the file now. */
    public int size() {
        return size;
    }

    /** Forgets a row that was in the file when it was opened for writing, and all after it. */
    public void dropFrom(int first) {
        try {
            content.setLength(starts.get(first));
            content.seek(starts.get(first));
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + AtomicFile.reason(file, e), e);
        }
        rows.subList(first, rows.size()).clear();
        size = first;
    }

    /** Forces all that was appended to the disk, so that after a power cut nothing is there that relies on what is not. */
    public void force() {
        try {
            content.getFD().sync();
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + AtomicFile.reason(file, e), e);
        }
    }

    /** Appends a row. */
    public void append(T row) {
        try {
            if (content == null) {
                reopen();
            }
            content.write((Json.line(row) + "\n").getBytes(StandardCharsets.UTF_8));
            size++;
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + AtomicFile.reason(file, e), e);
        }
    }

    @Override
    public void close() {
        try {
            if (content != null) {
                if (isNew && size == 0) {
                    Files.deleteIfExists(file);  // while it is locked
                }
                isNew = false;
                content.close();
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot close " + AtomicFile.reason(file, e), e);
        }
    }
}
