package io.natator.file;

import io.natator.base.InvalidInputException;
import io.natator.config.FileErrors;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.LinkOption;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.StandardOpenOption;
import java.nio.file.attribute.BasicFileAttributes;

/** A file that the user names and that is written whole or not at all. */
public final class OutputFile {

    private final Path named;
    private final Path target;

    private OutputFile(Path named, Path target) {
        this.named = named;
        this.target = target;
    }

    /**
     * The file of this name; of a symbolic link, the one that it leads to.
     *
     * @throws InvalidInputException if something else is there that is not to be replaced, such as a folder, a device or
     *                               a pipe; if its folder does not exist or takes no files; or if its name is too long
     */
    public static OutputFile of(Path named) {
        Path target = followed(named);
        if (Files.exists(target) && !Files.isRegularFile(target)) {
            throw new InvalidInputException("output file is " + named + ", which is "
                    + (Files.isDirectory(target) ? "a folder" : "a device or a pipe")
                    + "; expected the name of a file, new or to be replaced");
        }
        Path folder = target.toAbsolutePath().getParent();
        if (!Files.isDirectory(folder)) {
            throw new InvalidInputException("output file is " + named + "; expected a folder that exists, unlike " + folder);
        }
        if (!Files.isWritable(folder)) {
            throw new InvalidInputException("output file is " + named + "; expected a folder that can be written to, unlike " + folder);
        }
        checkName(named, fresh(target));
        return new OutputFile(named, target);
    }

    /** Refuses a name that no file can have. */
    private static void checkName(Path named, Path fresh) {
        try {
            Files.readAttributes(fresh, BasicFileAttributes.class, LinkOption.NOFOLLOW_LINKS);
        } catch (NoSuchFileException e) {
            return;  // as it should be
        } catch (IOException e) {
            throw new InvalidInputException("output file is " + named + "; expected another name: " + FileErrors.reason(fresh, e)
                    + ", with the .new that it is written by", e);
        }
    }

    /** What is written before it is renamed. */
    private static Path fresh(Path target) {
        return target.resolveSibling(target.getFileName() + ".new");
    }

    /** Where links end, even if nothing is there. */
    private static Path followed(Path path) {
        Path end = path;
        try {
            for (int links = 0; Files.isSymbolicLink(end); links++) {
                if (links > 40) {
                    throw new InvalidInputException("output file is " + path + ", a link that leads to itself");
                }
                end = end.resolveSibling(Files.readSymbolicLink(end));
            }
            return end;
        } catch (IOException e) {
            throw new InvalidInputException("output file " + path + ": " + FileErrors.reason(path, e), e);
        }
    }

    /** Replaces what is there: writes beside it and renames. */
    public void write(byte[] content) {
        Path fresh = fresh(target);
        try {
            Files.deleteIfExists(fresh);
            Files.write(fresh, content, StandardOpenOption.CREATE_NEW);
            Files.move(fresh, target, StandardCopyOption.REPLACE_EXISTING);
        } catch (IOException e) {
            fresh.toFile().delete();
            throw new UncheckedIOException("cannot write " + named + ": " + FileErrors.whyNotMade(named, e), e);
        }
    }
}
