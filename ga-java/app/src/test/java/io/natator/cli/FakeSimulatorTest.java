package io.natator.cli;

import io.natator.process.FakeSimulator;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;

/** Commands of {@code natator} with a simulator that computes nothing and has faults on demand; {@link FakeSimulator}. */
abstract class FakeSimulatorTest {

    @TempDir
    Path folder;
    final StringWriter out = new StringWriter();
    final StringWriter err = new StringWriter();
    private Path simulator;

    @BeforeEach
    void fake() {
        simulator = FakeSimulator.in(folder);
    }

    /** Runs a command of the fake's. */
    int natator(String... arguments) {
        CommandLine command = Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true));
        List<String> all = new ArrayList<>(List.of(arguments));
        all.addAll(1, List.of("--simulator-path", simulator.toString()));
        if (arguments[0].equals("show")) {
            return command.execute(arguments);
        }
        if (!List.of("evaluate", "converge").contains(arguments[0])) {
            // The fake's faults are not what the cache is to keep.
            all.add(1, "--no-cache");
        }
        return command.execute(all.toArray(String[]::new));
    }

    /** Evolves eight gaits for three generations into a folder of that name. */
    int evolve(String runName, String... more) {
        return evolveTo(3, runName, more);
    }

    int evolveTo(int generations, String runName, String... more) {
        List<String> arguments = new ArrayList<>(List.of("evolve", "--population", "8", "--generations", "" + generations, "--seed",
                "5", "--output-dir", folder.resolve(runName).toString()));
        arguments.addAll(List.of(more));
        return natator(arguments.toArray(String[]::new));
    }

    /** What was printed so far. */
    void forget() {
        out.getBuffer().setLength(0);
        err.getBuffer().setLength(0);
    }

    String file(String runName, String name) throws IOException {
        return Files.readString(folder.resolve(runName).resolve(name));
    }
}
