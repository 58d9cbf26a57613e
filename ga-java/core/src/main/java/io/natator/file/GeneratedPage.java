package io.natator.file;

import io.natator.config.FileErrors;
import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

/** The {@code README.md} of a folder with results: a page that is written anew at every run, beside tables and pictures. */
public final class GeneratedPage {

    /** The page's name. */
    public static final String NAME = "README.md";
    /** By this a page tells that it was generated. */
    public static final String MARK = "Generated; do not edit.";

    private GeneratedPage() {
    }

    /**
     * Refuses a folder in which somebody's own page would be overwritten.
     *
     * @param folder where a page and what belongs to it are to be written; it need not exist
     * @throws InvalidInputException if it is no folder, or has a page without the mark
     */
    public static void check(Path folder) {
        if (Files.exists(folder) && !Files.isDirectory(folder)) {
            throw new InvalidInputException("output folder " + folder + " is a file; choose another by --output-dir");
        }
        Path page = folder.resolve(NAME);
        try {
            if (Files.exists(page) && !Files.readString(page).contains(MARK)) {
                throw new InvalidInputException("output folder " + folder + " has a " + NAME
                        + " that natator did not write; choose another by --output-dir");
            }
        } catch (IOException e) {
            throw new InvalidInputException(page + " cannot be read: " + FileErrors.reason(page, e), e);
        }
    }
}
