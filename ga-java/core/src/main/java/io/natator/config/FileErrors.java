package io.natator.config;

import io.natator.base.InvalidInputException;
import java.io.IOException;
import java.io.InputStream;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.nio.file.AccessDeniedException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.FileSystemException;
import java.nio.file.Files;
import java.nio.file.LinkOption;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;

/** What went wrong with a file, in words: Java's own messages are often but its name. */
public final class FileErrors {

    private FileErrors() {
    }

    /**
     * Refuses what is there and is no file: reading a pipe would wait for ever, a folder cannot be replaced.
     *
     * @throws InvalidInputException naming it
     */
    public static void checkRegular(Path file) {
        if (!Files.isRegularFile(file) && Files.exists(file, LinkOption.NOFOLLOW_LINKS)) {
            throw new InvalidInputException(file + (Files.isDirectory(file) ? " is a folder; expected a file"
                    : Files.exists(file) ? " is not a regular file" : " is a link that leads nowhere"));
        }
    }

    /**
     * The text of a file that is not too large to be read as a whole; of a device or a pipe, which tells no size, no more is read.
     *
     * @throws IOException that says that it is, or is no UTF-8
     */
    static String text(Path file) throws IOException {
        byte[] content = {};
        boolean isSmall = Files.size(file) <= Limits.FILE_BYTES;
        if (isSmall) {
            try (InputStream in = Files.newInputStream(file)) {
                content = in.readNBytes(Limits.FILE_BYTES);
                isSmall = in.read() < 0;
            }
        }
        if (!isSmall) {
            throw new IOException("larger than " + Limits.FILE_BYTES + " bytes");
        }
        return StandardCharsets.UTF_8.newDecoder().decode(ByteBuffer.wrap(content)).toString();
    }

    /** Why, without the file's name where the error is about the file itself. */
    public static String reason(Path file, IOException e) {
        String why = e instanceof AccessDeniedException ? "permission denied"
                : e instanceof NoSuchFileException ? "no such file or folder"
                        : e instanceof FileAlreadyExistsException
                                ? Files.exists(file) ? "is a file, not a folder" : "is a link that leads nowhere"
                                : e instanceof FileSystemException system && system.getReason() != null
                                        ? system.getReason() : String.valueOf(e.getMessage());
        String about = e instanceof FileSystemException system ? system.getFile() : null;
        return about == null || about.equals(file.toString()) || why.contains(about) ? why : about + ": " + why;
    }

    /** Why a file or folder could not be made, likewise: that it was not there is no reason, but what it was to be in may be. */
    public static String whyNotMade(Path file, IOException e) {
        String about = e instanceof FileSystemException system ? system.getFile() : null;
        Path place = about == null ? null : Path.of(about).toAbsolutePath().getParent();
        Path there = place;
        while (there != null && !Files.exists(there)) {
            there = there.getParent();
        }
        if (there != null && !Files.isDirectory(there)) {
            return there + " is a file, not a folder";
        }
        return e instanceof NoSuchFileException && place != null && place.equals(there)
                ? place + " takes no new files or folders" : reason(file, e);
    }
}
