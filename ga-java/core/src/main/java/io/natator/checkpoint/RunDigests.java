package io.natator.checkpoint;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.base.Sha256;
import io.natator.config.FileErrors;
import io.natator.config.Json;
import io.natator.file.AtomicFile;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.RandomAccessFile;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.Stream;

/**
 * Digests by which a run notices that its files were edited, cut or removed. {@code digests.txt} has a line for each of
 * {@code evaluations.jsonl}, the digest of that and all before; {@code digests.json} has those of files that are written as a
 * whole, two of one that is about to be replaced, as a kill leaves the old or the new one. Each is written before what it is of. What
 * has no digest, as in a run of an earlier version, is taken as it is, and has one from then on.
 */
final class RunDigests implements AutoCloseable {

    static final String WHOLE = "digests.json";
    static final String LINES = "digests.txt";
    private static final String ABSENT = "";
    private static final int DIGITS = 16;
    private static final int LINE_BYTES = DIGITS + 1;
    private static final String HINT = "; expected it as the run wrote it (without " + WHOLE + " and " + LINES
            + " it goes on as it is)";
    /** What follows from other files where it is not there, or cannot be read. */
    private static final List<String> REMADE = List.of(RunWriter.CHECKPOINT, RunWriter.BEST, RunWriter.SAVINGS);

    private final Path directory;
    private final Map<String, List<String>> whole;
    private final RandomAccessFile lines;
    private String last = "";

    /** Files and their digests. */
    private static final class Content extends TreeMap<String, List<String>> {
        private static final long serialVersionUID = 1L;
    }

    /** The digests of a folder, which must be locked. */
    RunDigests(Path directory) {
        this.directory = directory;
        this.whole = read(directory);
        try {
            lines = new RandomAccessFile(directory.resolve(LINES).toFile(), "rw");
        } catch (IOException e) {
            throw new InvalidInputException("cannot open " + AtomicFile.reason(directory.resolve(LINES), e), e);
        }
    }

    private static Map<String, List<String>> read(Path directory) {
        Path file = directory.resolve(WHOLE);
        FileErrors.checkRegular(file);
        return Files.exists(file) ? Json.read(file, Content.class, "digests") : new TreeMap<>();
    }

    /**
     * What of a folder, but for its evaluations, is not as the run wrote it, in one line; null if all is.
     *
     * @throws InvalidInputException if the digests cannot be read
     */
    static String damage(Path directory) {
        for (Map.Entry<String, List<String>> one : read(directory).entrySet()) {
            Path file = directory.resolve(one.getKey());
            boolean isThere = Files.exists(file);
            if (REMADE.contains(one.getKey()) && (!isThere || !isJson(file))) {
                continue;
            }
            if (!isThere && !one.getValue().contains(ABSENT)) {
                return directory + " is damaged: it has no " + one.getKey() + HINT;
            }
            if (isThere && !one.getValue().contains(digest(file))) {
                return file + " was edited" + HINT;
            }
        }
        return null;
    }

    private static boolean isJson(Path file) {
        try {
            Json.read(file, JsonNode.class, "file");
            return true;
        } catch (InvalidInputException e) {
            return false;
        }
    }

    /** Digest of a file; of a file of lines without the last one, should its writer have been killed within it. */
    private static String digest(Path file) {
        try {
            byte[] content = Files.readAllBytes(file);
            int end = content.length;
            while (end > 0 && content[end - 1] != '\n') {
                end--;
            }
            boolean isLines = file.toString().endsWith(".jsonl");
            return Sha256.of(isLines ? Arrays.copyOf(content, end) : content);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + AtomicFile.reason(file, e), e);
        }
    }

    /** Writes a file, once it is noted what it is about to become. */
    void write(String name, String content) {
        Path file = directory.resolve(name);
        boolean isNew = !Files.exists(file);
        note(name, isNew ? ABSENT : digest(file), Sha256.of(content));
        AtomicFile.write(file, content);
        if (isNew) {
            note(name, Sha256.of(content));
        }
    }

    private void note(String name, String... digests) {
        whole.put(name, Stream.of(digests).distinct().toList());
        AtomicFile.write(directory.resolve(WHOLE), Json.document(whole));
    }

    /**
     * Compares the evaluations with their digests.
     *
     * @param recorded how many there are
     * @throws InvalidInputException if one was edited
     */
    void check(int recorded) {
        try (BufferedReader log = Files.newBufferedReader(directory.resolve(RunWriter.EVALUATIONS),
                StandardCharsets.UTF_8)) {
            long known = lines.length() / LINE_BYTES;
            lines.seek(0);
            last = "";
            byte[] digest = new byte[LINE_BYTES];
            for (int row = 0; row < recorded; row++) {
                last = next(log.readLine());
                if (row >= known) {
                    lines.writeBytes(last + "\n");
                    continue;
                }
                lines.readFully(digest);
                if (!(last + "\n").equals(new String(digest, StandardCharsets.ISO_8859_1))) {
                    throw new InvalidInputException(
                            directory.resolve(RunWriter.EVALUATIONS) + ", line " + (row + 1) + " was edited" + HINT);
                }
            }
            lines.setLength(lines.getFilePointer());
        } catch (IOException e) {
            throw new InvalidInputException(
                    "cannot read " + AtomicFile.reason(directory.resolve(RunWriter.EVALUATIONS), e), e);
        }
    }

    private String next(String line) {
        return Sha256.of(last + line).substring(0, DIGITS);
    }

    /** Notes an evaluation that is about to be recorded. */
    void expectEvaluation(String line) {
        try {
            last = next(line);
            lines.writeBytes(last + "\n");
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + AtomicFile.reason(directory.resolve(LINES), e), e);
        }
    }

    /** Removes the digests, changes the run's files, and notes the digests of those that are left. */
    static void renew(Path directory, Runnable change) {
        boolean isKnown = Files.exists(directory.resolve(WHOLE));
        try {
            Files.deleteIfExists(directory.resolve(LINES));
            Files.deleteIfExists(directory.resolve(WHOLE));
        } catch (IOException e) {
            throw new UncheckedIOException("cannot remove " + AtomicFile.reason(directory.resolve(WHOLE), e), e);
        }
        change.run();
        if (isKnown) {
            Map<String, List<String>> left = new TreeMap<>();
            Stream.of(RunWriter.CHECKPOINT, CompactRun.WHOLE, RunWriter.BEST, RunWriter.SAVINGS, RunWriter.VACUUM)
                    .filter(name -> Files.exists(directory.resolve(name)))
                    .forEach(name -> left.put(name, List.of(digest(directory.resolve(name)))));
            AtomicFile.write(directory.resolve(WHOLE), Json.document(left));
        }
    }

    @Override
    public void close() {
        if (!lines.getChannel().isOpen()) {
            return;
        }
        try {
            boolean isEmpty = lines.length() == 0;
            lines.close();
            if (isEmpty) {
                Files.deleteIfExists(directory.resolve(LINES));
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot close " + AtomicFile.reason(directory.resolve(LINES), e), e);
        }
    }
}
