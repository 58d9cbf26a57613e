package io.natator.cli;

import io.natator.process.FakeSimulator;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;

/** Commands of {@code natator} with a simulator that computes nothing and has faults on demand; {@link FakeSimulator}. */
abstract class FakeSimulatorTest extends CommandTest {

    private Path simulator;

    @BeforeEach
    void fake() {
        simulator = FakeSimulator.in(folder);
    }

    /** Runs a command with the fake. */
    @Override
    int natator(String... arguments) {
        List<String> all = new ArrayList<>(List.of(words(arguments)));
        if (!List.of("show", "evaluate", "converge").contains(all.get(0))) {
            // The fake's faults are not what the cache is to keep.
            all.add(1, "--no-cache");
        }
        return with(simulator, all.toArray(String[]::new));
    }

    /** Evolves eight gaits for three generations into a folder of that name. */
    int evolve(String runName, String... more) {
        return evolveTo(3, runName, more);
    }

    int evolveTo(int generations, String runName, String... more) {
        List<String> arguments = new ArrayList<>(List.of("evolve", "--output-dir", path(runName)));
        arguments.addAll(List.of("--population", "8", "--seed", "5", "--generations", "" + generations));
        arguments.addAll(List.of(more));
        if (!arguments.contains("--scene") && !arguments.contains("--creature")) {
            arguments.addAll(List.of("--creature", "1"));
        }
        return natator(arguments);
    }
}
