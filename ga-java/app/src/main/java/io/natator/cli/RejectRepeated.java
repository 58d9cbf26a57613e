package io.natator.cli;

import io.natator.base.InvalidInputException;
import java.io.IOException;
import java.nio.file.Path;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.function.Function;

/** Refuses what an option names twice. */
final class RejectRepeated {

    private RejectRepeated() {
    }

    /**
     * Checks a list.
     *
     * @param option its name
     * @param text   how a value was given
     * @throws InvalidInputException naming the first value that stands there again, or if there is none
     */
    static <T> void check(String option, List<T> values, Function<T, String> text) {
        if (values.isEmpty()) {
            throw new InvalidInputException(option + " is empty; expected at least one value");
        }
        Set<T> before = new HashSet<>();
        values.stream().filter(one -> !before.add(one)).findFirst().ifPresent(one -> {
            throw new InvalidInputException(option + " has " + text.apply(one) + " twice; expected each once");
        });
    }

    /** Checks a list of folders, whatever paths lead to them; a missing one is refused elsewhere. */
    static void checkFolders(String option, List<Path> folders) {
        List<Path> places = folders.stream().map(RejectRepeated::real).toList();
        check(option, places, one -> folders.get(places.indexOf(one)).toString());
    }

    private static Path real(Path folder) {
        try {
            return folder.toRealPath();
        } catch (IOException e) {
            return folder.toAbsolutePath().normalize();
        }
    }
}
