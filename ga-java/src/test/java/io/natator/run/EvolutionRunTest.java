package io.natator.run;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.Savings;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.ToySimulator;
import io.natator.simulator.Evaluator;
import io.natator.simulator.FakeSimulator;
import io.natator.simulator.WorkerPool;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class EvolutionRunTest {

    private static final EvolutionSettings SETTINGS =
            EvolutionSettings.of("thesis/creature-3", EncodingKind.DENSE, 5).withSize(12, 5).withSeed(3);

    @TempDir
    private Path folder;
    private ExecutionSettings execution;

    @BeforeEach
    void fake() {
        execution = new ExecutionSettings(FakeSimulator.in(folder), 2, Duration.ofSeconds(20));
    }

    /** Runs in a folder of this name; gives the number of simulations. */
    private int run(String name, EvolutionSettings settings, ExecutionSettings how) throws InterruptedException {
        ToySimulator simulator = new ToySimulator();
        try (RunFolder run = RunFolder.create(folder.resolve(name), settings);
                Evaluator evaluator = new WorkerPool(simulator, 2)) {
            new EvolutionRun(run).run(how, evaluator);
        }
        return simulator.calls();
    }

    private void assertSame(String one, String other) {
        for (String file : List.of("generations.csv", "best.json", "checkpoint.json", "evaluations.jsonl")) {
            assertThat(folder.resolve(one).resolve(file)).hasSameBinaryContentAs(folder.resolve(other).resolve(file));
        }
    }

    @Test
    void theCacheSavesEvaluationsAndChangesNoByte() throws InterruptedException {
        ExecutionSettings cached = execution.withCache(folder.resolve("cache"));

        int without = run("without", SETTINGS, execution);
        int first = run("first", SETTINGS, cached);
        int second = run("second", SETTINGS, cached);
        int longer = run("longer", SETTINGS.withSize(12, 6), cached);

        assertThat(first).isEqualTo(without);
        assertThat(second).isZero();
        assertThat(longer).isBetween(1, without / 4);
        assertSame("first", "without");
        assertSame("second", "without");
        assertThat(RunFolder.savings(folder.resolve("without")).fromCache()).isZero();
        Savings savings = RunFolder.savings(folder.resolve("second"));
        assertThat(savings.fromCache()).isEqualTo(savings.evaluations()).isEqualTo(without - 1);
    }

    @Test
    void damagedEntriesAreSimulatedAnew() throws InterruptedException, IOException {
        ExecutionSettings cached = execution.withCache(folder.resolve("cache"));
        int all = run("first", SETTINGS, cached);
        int damaged = 0;
        try (var files = Files.walk(folder.resolve("cache"))) {
            for (Path file : files.filter(Files::isRegularFile).limit(7).toList()) {
                Files.writeString(file, damaged++ % 2 == 0 ? "" : Files.readString(file).replace("ok", "no"));
            }
        }

        assertThat(run("second", SETTINGS, cached)).isEqualTo(7).isLessThan(all);
        assertSame("second", "first");
    }

    /** Counted in another way: from the generations of the final state. */
    @Test
    void savingsAddUp() throws InterruptedException, IOException {
        run("run", SETTINGS, execution);

        Savings savings = RunFolder.savings(folder.resolve("run"));
        EvolutionState end;
        try (RunFolder run = RunFolder.open(folder.resolve("run"))) {
            end = run.checkpoint();
        }
        assertThat(savings.evaluations()).isEqualTo(end.evaluations());
        assertThat(savings.unchanged() + savings.evaluations())
                .isEqualTo(end.history().stream().mapToLong(one -> one.population()).sum());
        assertThat(savings.unchanged()).isGreaterThanOrEqualTo(5 * 12);
        assertThat(savings.wholeSeconds()).isEqualTo(4.0 * end.evaluations());
        assertThat(savings.stoppedEarly()).isZero();
        assertThat(savings.shareOfEarlyStops()).isZero();
    }
}
