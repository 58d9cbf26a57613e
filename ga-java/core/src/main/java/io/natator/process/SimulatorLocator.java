package io.natator.process;

import io.natator.base.InvalidInputException;
import io.natator.protocol.RequestRejectedException;
import java.io.File;
import java.io.IOException;
import java.io.InputStream;
import java.net.URISyntaxException;
import java.nio.file.DirectoryStream;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.security.CodeSource;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;

/**
 * Finds the native program: the first of
 * <ol>
 * <li>the one that the caller names;
 * <li>the one that the environment variable {@value #VARIABLE} names;
 * <li>the one that came with this jar: {@code bin/natator-sim} of the prefix whose {@code share/natator} holds the jar (the
 * Debian package, {@code cmake --install}), or {@code build/release/bin/natator-sim} of the checkout that the jar is in;
 * <li>{@code natator-sim} on the {@code PATH}: of an active Python environment, the Debian package, any other;
 * <li>{@code ~/.local/bin/natator-sim}, where {@code pip install --user} and pipx put it;
 * <li>that of the checkout which the working directory is in.
 * </ol>
 * Where that is the command of the Python wheel, it is the program inside the package. It must be of the version that this
 * jar is of.
 */
public final class SimulatorLocator {

    /** Environment variable with the path of the program. */
    public static final String VARIABLE = "NATATOR_SIM";
    private static final String NAME = "natator-sim";
    private static final Path BUILT = Path.of("build", "release", "bin", NAME);
    private static final Path DATA = Path.of("share", "natator");
    private static final Path BIN = Path.of("bin", NAME);
    private static final byte[] ELF = {0x7f, 'E', 'L', 'F'};
    private static final Map<String, Integer> MACHINES = Map.of("amd64", 0x3e, "aarch64", 0xb7);

    private SimulatorLocator() {
    }

    /**
     * The program.
     *
     * @param given path from the command line, or null
     * @throws InvalidInputException if there is no executable program, or it says that it is of another version
     * @throws InterruptedException  if interrupted while the program is asked for its version
     */
    public static Path locate(Path given) throws InterruptedException {
        String variable = System.getenv(VARIABLE);
        Path program;
        if (given != null) {
            program = executable(given, "--simulator-path");
        } else if (variable != null && !variable.isBlank()) {
            program = executable(Path.of(variable), VARIABLE);
        } else {
            program = first(places(jar(), System.getenv("PATH"), Path.of(System.getProperty("user.home")),
                    Path.of("").toAbsolutePath()));
        }
        program = insideWheel(program);
        requireVersion(program, SimulatorLocator.class.getPackage().getImplementationVersion());
        return program;
    }

    private static Path executable(Path path, String source) {
        if (isProgram(path)) {
            return path.toAbsolutePath().normalize();
        }
        throw new InvalidInputException(source + " is " + path + "; expected an executable file");
    }

    private static boolean isProgram(Path path) {
        return Files.isRegularFile(path) && Files.isExecutable(path);
    }

    /** The first of the places that has a program. */
    static Path first(List<Path> places) {
        return places.stream().filter(SimulatorLocator::isProgram).findFirst()
                .orElseThrow(() -> new InvalidInputException(
                        "no " + NAME
                                + " beside this jar, on the PATH, in ~/.local/bin or built in a checkout; install Natator's Debian package "
                                + "or Python wheel, or name the program by --simulator-path or " + VARIABLE));
    }

    /**
     * Where a program is looked for that nobody names, in this order.
     *
     * @param code      the jar or folder that this class was loaded from; null if it was no file
     * @param path      folders of programs, as in {@code PATH}; or null
     * @param home      of the user
     * @param directory the working directory
     */
    static List<Path> places(Path code, String path, Path home, Path directory) {
        List<Path> places = new ArrayList<>();
        if (code != null) {
            Path folder = code.getParent();
            if (folder != null && folder.endsWith(DATA)) {
                places.add(folder.resolve("../..").normalize().resolve(BIN));
            }
            addBuilt(code, places);
        }
        for (String folder : (path == null ? "" : path).split(File.pathSeparator)) {
            try {
                if (!folder.isEmpty()) {
                    places.add(directory.resolve(folder).resolve(NAME));
                }
            } catch (InvalidPathException e) {
                // Letters that no file of this system can have.
            }
        }
        places.add(home.resolve(".local").resolve(BIN));
        addBuilt(directory, places);
        return places;
    }

    /** Adds the program of each checkout that a file or folder may be in. */
    private static void addBuilt(Path start, List<Path> places) {
        for (Path folder = start; folder != null; folder = folder.getParent()) {
            places.add(folder.resolve(BUILT));
        }
    }

    private static Path jar() {
        CodeSource source = SimulatorLocator.class.getProtectionDomain().getCodeSource();
        try {
            return source == null ? null : Path.of(source.getLocation().toURI()).toRealPath();
        } catch (URISyntaxException | IllegalArgumentException | IOException e) {
            return null;  // Code that was not loaded from a file says nothing about where the program is.
        }
    }

    /** The program that a wheel's command starts, which is a script; others as they are. A cluster is sent the file itself. */
    static Path insideWheel(Path program) {
        try (InputStream file = Files.newInputStream(program)) {
            if (file.read() == '#' && file.read() == '!') {
                Path libraries = program.toRealPath().resolve("../../lib").normalize();
                for (String packages : List.of("site-packages", "dist-packages")) {
                    try (DirectoryStream<Path> pythons = Files.newDirectoryStream(libraries, "python3*")) {
                        for (Path python : pythons) {
                            Path inside = python.resolve(packages).resolve("natator/program").resolve(BIN);
                            if (isProgram(inside)) {
                                return inside;
                            }
                        }
                    }
                }
            }
        } catch (IOException e) {
            // Not a wheel's.
        }
        return program;
    }

    /**
     * Refuses a program of another version, and one of machine code that does not run on this system. Others that do not say
     * their version are told at their first use.
     *
     * @param version this jar's; null of classes outside one, for which any program will do
     */
    static void requireVersion(Path program, String version) throws InterruptedException {
        if (version == null) {
            return;
        }
        String expected = version.replaceFirst("-SNAPSHOT$", "");
        Integer machine = machine(program);
        if (machine != null && !machine.equals(MACHINES.getOrDefault(System.getProperty("os.arch"), machine))) {
            throw runsElsewhere(program, null);  // Started, it would be taken for a script.
        }
        String found = null;
        try {
            found = ProgramInfo.version(program);
        } catch (RequestRejectedException e) {
            if (machine != null) {
                throw runsElsewhere(program, e);
            }
        }
        if (found != null && !found.equals(expected)) {
            throw new InvalidInputException(program + " is " + NAME + " " + found + ", this is natator " + expected
                    + "; expected the same version: install or build both again, or name another program by --simulator-path or "
                    + VARIABLE);
        }
    }

    private static InvalidInputException runsElsewhere(Path program, Exception cause) {
        return new InvalidInputException(program + " does not run here; expected " + NAME
                + " for this kind of processor and a C library no newer than this system's: build it on this machine by mvn compile in a "
                + "checkout, or name another program by --simulator-path or " + VARIABLE, cause);
    }

    /** The kind of processor that machine code is for, e_machine of ELF; null of what is none. */
    private static Integer machine(Path program) {
        try (InputStream file = Files.newInputStream(program)) {
            byte[] header = file.readNBytes(20);
            return header.length == 20 && Arrays.equals(header, 0, ELF.length, ELF, 0, ELF.length)
                    ? (header[18] & 0xff) + ((header[19] & 0xff) << 8)
                    : null;
        } catch (IOException e) {
            return null;
        }
    }
}
