package io.natator.file;

import io.natator.base.InvalidInputException;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;

/** A file that the user names and that is written whole or not at all. */
public final class OutputFile {

    private OutputFile() {
    }

    /**
     * Looks whether a file of this name can be written. To be called before anything is computed.
     *
     * @throws InvalidInputException if something else is there, such as a folder, a device or a pipe; or if its folder does not exist or
     *                               takes no files
     */
    public static void check(Path file) {
        Path folder = file.toAbsolutePath().getParent();
        boolean isOther = Files.exists(file) && !Files.isRegularFile(file);
        String fault = isOther ? ", which is " + (Files.isDirectory(file) ? "a folder" : "a device or a pipe")
                + "; expected the name of a file, new or to be replaced"
                : !Files.isDirectory(folder) ? "; expected a folder that exists, unlike " + folder
                        : !Files.isWritable(folder) ? "; expected a folder that can be written to, unlike " + folder
                                : null;
        if (fault != null) {
            throw new InvalidInputException("output file is " + file + fault);
        }
    }

    /**
     * Also looks whether a file is there already, which only {@code --force} replaces.
     *
     * @param option that names the file
     * @throws InvalidInputException also if one is there, unless it is to be replaced
     */
    public static void check(Path file, String option, boolean force) {
        check(file);
        if (!force && Files.exists(file)) {
            throw new InvalidInputException("output file " + file + " is already there; choose another by " + option
                    + ", or replace it by --force");
        }
    }

    /**
     * Replaces what is there, as {@link AtomicFile} does; of a symbolic link, what it leads to.
     *
     * @throws UncheckedIOException if that fails
     */
    public static void write(Path file, byte[] content) {
        check(file);
        try {
            AtomicFile.write(Files.exists(file) ? file.toRealPath() : file, content);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + AtomicFile.reason(file, e), e);
        }
    }
}
