package io.natator.process;

import io.natator.base.InvalidInputException;
import java.net.URISyntaxException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.CodeSource;
import java.util.ArrayList;
import java.util.List;

/** Finds the native program. */
public final class SimulatorLocator {

    /** Environment variable with the path of the program. */
    public static final String VARIABLE = "NATATOR_SIM";
    private static final Path BUILT = Path.of("build", "release", "bin", "natator-sim");

    private SimulatorLocator() {
    }

    /**
     * The program at the given path, else the one that {@value #VARIABLE} names, else the one built in the working
     * directory, in the jar's directory, or in a directory above either.
     *
     * @param given path from the command line, or null
     * @throws InvalidInputException if there is no executable program
     */
    public static Path locate(Path given) {
        String variable = System.getenv(VARIABLE);
        if (given != null) {
            return executable(given, "--simulator-path");
        }
        if (variable != null && !variable.isBlank()) {
            return executable(Path.of(variable), VARIABLE);
        }
        for (Path start : startingPoints()) {
            for (Path directory = start; directory != null; directory = directory.getParent()) {
                Path candidate = directory.resolve(BUILT);
                if (Files.isExecutable(candidate)) {
                    return candidate;
                }
            }
        }
        throw new InvalidInputException("simulator " + BUILT + " not found; build it (mvn compile), "
                + "or name it by --simulator-path or " + VARIABLE);
    }

    private static Path executable(Path path, String source) {
        if (Files.isRegularFile(path) && Files.isExecutable(path)) {
            return path.toAbsolutePath().normalize();
        }
        throw new InvalidInputException(source + " is " + path + "; expected an executable file");
    }

    private static List<Path> startingPoints() {
        List<Path> points = new ArrayList<>();
        points.add(Path.of("").toAbsolutePath());
        CodeSource source = SimulatorLocator.class.getProtectionDomain().getCodeSource();
        if (source != null) {
            try {
                points.add(Path.of(source.getLocation().toURI()).toAbsolutePath());
            } catch (URISyntaxException | IllegalArgumentException e) {
                // Code that was not loaded from a file says nothing about where the program is.
            }
        }
        return points;
    }
}
