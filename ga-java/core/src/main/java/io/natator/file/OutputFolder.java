package io.natator.file;

import io.natator.base.InvalidInputException;
import io.natator.config.FileErrors;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.LinkOption;
import java.nio.file.Path;

/** A folder that the user names for what is going to be computed. */
public final class OutputFolder {

    private OutputFolder() {
    }

    /**
     * Makes it, and those that it is in, unless it is there. To be called before anything is computed.
     *
     * @throws InvalidInputException that says why it cannot be made or written to
     */
    public static void make(Path folder) {
        try {
            Files.createDirectories(folder);
        } catch (IOException e) {
            throw cannotBeMade(folder, e);
        }
        if (!Files.isWritable(folder)) {
            throw new InvalidInputException("output folder " + folder + " cannot be written to");
        }
    }

    /**
     * Looks whether {@link #make} would refuse it; makes nothing.
     *
     * @throws InvalidInputException as {@link #make}
     */
    public static void check(Path folder) {
        Path whole = folder.toAbsolutePath().normalize();
        Path there = whole;
        while (!Files.exists(there, LinkOption.NOFOLLOW_LINKS)) {
            there = there.getParent();
        }
        if (there.equals(whole) || !Files.isDirectory(there) || !Files.isWritable(there)) {
            make(folder);  // which is there, or cannot be made
        }
    }

    /** Says that it cannot be made, and why. */
    public static InvalidInputException cannotBeMade(Path folder, IOException e) {
        return new InvalidInputException(
                "output folder " + folder + " cannot be made: " + FileErrors.whyNotMade(folder, e), e);
    }
}
