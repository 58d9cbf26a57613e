package io.natator.cli;

import io.natator.base.InvalidInputException;
import java.io.IOException;
import java.nio.file.Path;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

/** Refuses a folder that an option names twice. */
final class RejectRepeated {

    private RejectRepeated() {
    }

    /**
     * Checks a list of folders, whatever paths lead to them; a missing one is refused elsewhere.
     *
     * @param option its name
     * @throws InvalidInputException naming the first that stands there again
     */
    static void checkFolders(String option, List<Path> folders) {
        Set<Path> before = new HashSet<>();
        for (Path folder : folders) {
            if (!before.add(real(folder))) {
                throw new InvalidInputException(option + " has " + folder + " twice; expected each once");
            }
        }
    }

    private static Path real(Path folder) {
        try {
            return folder.toRealPath();
        } catch (IOException e) {
            return folder.toAbsolutePath().normalize();
        }
    }
}
