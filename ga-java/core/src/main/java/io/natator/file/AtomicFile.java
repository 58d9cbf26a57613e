package io.natator.file;

import java.io.FileOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.AccessDeniedException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;

/** Writes files that are at every moment either the old or the new one, whole. */
public final class AtomicFile {

    private AtomicFile() {
    }

    /**
     * Replaces a file: writes beside it, forces that to the disk, and renames. An interrupt does not disturb it.
     *
     * @throws UncheckedIOException if that fails; the old file is then untouched
     */
    public static void write(Path file, String content) {
        write(file, content.getBytes(StandardCharsets.UTF_8));
    }

    /** Replaces a file by bytes; see {@link #write(Path, String)}. */
    public static void write(Path file, byte[] content) {
        Path fresh = unfinished(file);
        try {
            try (FileOutputStream out = new FileOutputStream(fresh.toFile())) {
                out.write(content);
                out.getFD().sync();
            }
            Files.move(fresh, file, StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + reason(file, e), e);
        }
    }

    private static Path unfinished(Path file) {
        return file.resolveSibling(file.getFileName() + ".new");
    }

    /** Removes what a write that was killed has left, if anything. */
    public static void deleteUnfinished(Path file) throws IOException {
        Files.deleteIfExists(unfinished(file));
    }

    /** The file and what is wrong with it, once each. */
    public static String reason(Path file, IOException e) {
        String message = e instanceof AccessDeniedException ? "permission denied" : String.valueOf(e.getMessage());
        return message.startsWith(file.toString()) ? message : file + ": " + message;
    }
}
