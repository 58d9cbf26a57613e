package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.base.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** Where the native program is looked for, and which is refused. */
class SimulatorLocatorTest {

    private static final String SAYS_VERSION = "#!/bin/sh\n[ \"$*\" = --version ] && echo 'natator-sim 0.2.0, commit unknown, instruction set avx2'\n";

    @TempDir
    private Path folder;

    private Path program(String place, String text) throws IOException {
        Path program = folder.resolve(place);
        Files.createDirectories(program.getParent());
        return FakeSimulator.program(program, text);
    }

    private Path found(String jar) {
        return SimulatorLocator
                .first(SimulatorLocator.places(folder.resolve(jar), "relative:" + folder.resolve("empty") + "::"
                        + folder.resolve("path"), folder.resolve("home"), folder.resolve("checkout/below")));
    }

    /** Each is found where those before it are not. */
    @Test
    void theFirstOfTheDocumentedOrderIsTaken() throws IOException {
        Path working = program("checkout/build/release/bin/natator-sim", "");
        assertThat(found("usr/share/natator/natator.jar")).isEqualTo(working);
        Path user = program("home/.local/bin/natator-sim", "");
        assertThat(found("usr/share/natator/natator.jar")).isEqualTo(user);
        Path path = program("path/natator-sim", "");
        assertThat(found("usr/share/natator/natator.jar")).isEqualTo(path);
        Path relative = program("checkout/below/relative/natator-sim", "");
        assertThat(found("usr/share/natator/natator.jar")).isEqualTo(relative);
        Path built = program("clone/build/release/bin/natator-sim", "");
        assertThat(found("clone/ga-java/target/natator.jar")).isEqualTo(built);
        Path installed = program("usr/bin/natator-sim", "");
        assertThat(found("usr/share/natator/natator.jar")).isEqualTo(installed);
        assertThat(found("usr/share/other/natator.jar")).isEqualTo(relative);
    }

    @Test
    void whatCannotBeRunIsNoProgram() throws IOException {
        Path path = program("path/natator-sim", "");
        Files.createDirectories(folder.resolve("usr/bin/natator-sim"));
        Files.createDirectories(folder.resolve("checkout/below/relative"));
        Files.createFile(folder.resolve("checkout/below/relative/natator-sim"));

        assertThat(found("usr/share/natator/natator.jar")).isEqualTo(path);
    }

    @Test
    void noneIsToldInOneLineWithTheWayOut() {
        assertThatThrownBy(() -> found("natator.jar")).isInstanceOf(InvalidInputException.class)
                .hasMessage("no natator-sim beside this "
                        + "jar, on the PATH, in ~/.local/bin or built in a checkout; install Natator's Debian package or Python wheel, or name the "
                        + "program by --simulator-path or NATATOR_SIM");
    }

    @Test
    void theCommandOfAWheelStandsForTheProgramInIt() throws IOException {
        Path command = program("venv/bin/natator-sim", "#!/usr/bin/env python3\n");
        assertThat(SimulatorLocator.insideWheel(command)).isEqualTo(command);
        Path inside = program("venv/lib/python3.11/site-packages/natator/program/bin/natator-sim", "\u007fELF");
        Files.createDirectories(folder.resolve("home"));
        Path link = Files.createSymbolicLink(folder.resolve("home/natator-sim"), command);

        assertThat(SimulatorLocator.insideWheel(command)).isEqualTo(inside);
        assertThat(SimulatorLocator.insideWheel(link)).isEqualTo(inside);
        Path other = program("venv/bin/natator-sim", "\u007fELF");
        assertThat(SimulatorLocator.insideWheel(other)).isEqualTo(other);
    }

    @Test
    void anotherVersionIsRefusedInOneLineWithTheWayOut() throws IOException, InterruptedException {
        Path program = program("natator-sim", SAYS_VERSION);
        SimulatorLocator.requireVersion(program, "0.2.0");
        SimulatorLocator.requireVersion(program, "0.2.0-SNAPSHOT");
        SimulatorLocator.requireVersion(program, null);

        assertThatThrownBy(() -> SimulatorLocator.requireVersion(program, "0.3.0-SNAPSHOT"))
                .isInstanceOf(InvalidInputException.class)
                .hasMessage(program
                        + " is natator-sim 0.2.0, this is natator 0.3.0; expected the same version: install or build both "
                        + "again, or name another program by --simulator-path or NATATOR_SIM");
    }

    /** The first is for 32-bit ARM, and would be run as a script; the second for a processor that this may be, but damaged. */
    @Test
    void machineCodeThatDoesNotRunIsRefusedInOneLineWithTheWayOut() throws IOException, InterruptedException {
        String header = "\u007fELF" + "\0".repeat(14);
        Path ran = folder.resolve("ran");
        for (String machine : List.of("(\0", System.getProperty("os.arch").equals("amd64") ? ">\0" : "\1\0")) {
            Path program = program("natator-sim", header + machine + "\nexit 1\n");
            SimulatorLocator.requireVersion(program, null);

            assertThatThrownBy(() -> SimulatorLocator.requireVersion(program, "0.2.0"))
                    .isInstanceOf(InvalidInputException.class)
                    .hasMessage(program
                            + " does not run here; expected natator-sim for this kind of processor and a C library no newer than "
                            + "this system's: build it on this machine by mvn compile in a checkout, or name another program by "
                            + "--simulator-path or NATATOR_SIM");
        }
        Path script = program("natator-sim", header + "(\0\n: >" + ran + "\n");
        assertThatThrownBy(() -> SimulatorLocator.requireVersion(script, "0.2.0"))
                .isInstanceOf(InvalidInputException.class);
        assertThat(ran).doesNotExist();
    }

    /** Its first use tells more. */
    @Test
    @Timeout(30)
    void aProgramThatSaysNoVersionPasses() throws IOException, InterruptedException {
        for (String text : List.of("#!/bin/sh\n", "#!/bin/sh\nexec sleep 3600\n", "#!/bin/sh\nexit 1\n")) {
            SimulatorLocator.requireVersion(program("natator-sim", text), "0.3.0");
        }
    }
}
