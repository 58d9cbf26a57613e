package io.natator.checkpoint;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.base.InvalidInputException;
import io.natator.config.Aggregate;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.OptimizerKind;
import io.natator.evolution.ToyEvolution;
import io.natator.evolution.ToySimulator;
import io.natator.process.Evaluator;
import io.natator.process.FakePool;
import io.natator.process.FakeSimulator;
import io.natator.run.EvolutionRun;
import io.natator.run.PlannedRun;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class CompactRunTest {

    private static final EvolutionSettings SETTINGS = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2);

    @TempDir
    private Path folder;
    private ExecutionSettings execution;

    @BeforeEach
    void fake() {
        execution = FakeSimulator.execution(folder);
    }

    @Test
    void aCompactRunIsStillFinishedAndHasItsResults() throws Exception {
        Path directory = folder.resolve("run");
        EvolutionSettings settings = SETTINGS.withSize(8, 3);
        try (RunWriter run = RunWriter.create(directory, settings);
                Evaluator evaluator = new FakePool(new ToySimulator(), 2)) {
            assertThatThrownBy(() -> CompactRun.compact(directory)).isInstanceOf(InvalidInputException.class)
                    .hasMessageContaining("not a finished run");
            new EvolutionRun(run).run(execution, evaluator);
        }
        RunReader before = RunReader.in(directory);
        assertThat(before.evaluations()).isNotEmpty();

        CompactRun.compact(directory);
        CompactRun.compact(directory);

        assertThat(RunReader.isFinished(directory)).isTrue();
        RunReader after = RunReader.in(directory);
        assertThat(after.best()).isEqualTo(before.best());
        assertThat(after.state().history()).isEqualTo(before.state().history());
        assertThat(after.state().evaluations()).isEqualTo(before.evaluations().size());
        assertThat(after.evaluations()).isEmpty();
        assertThat(Files.size(directory.resolve("checkpoint.json"))).isLessThan(5000);
    }

    private void evolve(Path directory, EvolutionSettings settings) throws Exception {
        try (RunWriter run = new PlannedRun(settings, directory).open();
                Evaluator evaluator = new FakePool(new ToySimulator(), 2)) {
            new EvolutionRun(run).run(execution, evaluator);
        }
    }

    /** Twice in parts: once from what is left of it alone, then from that and the evaluations since. */
    @ParameterizedTest
    @CsvSource({"JGAP, 1", "JGAP, 2", "RANDOM, 1", "MAP_ELITES, 2", "NSGA2, 1"})
    void aCompactRunGoesOnAsIfItHadNeverStopped(OptimizerKind optimizer, int starts) throws Exception {
        EvolutionSettings settings = ToyEvolution.by(optimizer, SETTINGS.withStarts(starts, Aggregate.MEAN));
        Path parts = folder.resolve("parts");
        evolve(parts, settings.withSize(8, 2));
        long dropped = RunReader.recorded(parts).end();
        CompactRun.compact(parts);
        assertThat(RunReader.recorded(parts).end()).isEqualTo(dropped);

        evolve(parts, settings.withSize(8, 3));
        assertThat(RunReader.in(parts).damage()).isNull();
        assertThat(RunReader.in(parts).evaluations()).as("not the whole course").isEmpty();
        evolve(parts, settings.withSize(8, 5));

        Path whole = folder.resolve("whole");
        evolve(whole, settings.withSize(8, 5));
        for (String name : List.of("config.json", "checkpoint.json", "best.json", "generations.csv", "savings.json")) {
            assertThat(parts.resolve(name)).as(name).hasSameTextualContentAs(whole.resolve(name));
        }
        List<String> evaluations = Files.readAllLines(whole.resolve("evaluations.jsonl"));
        assertThat(Files.readAllLines(parts.resolve("evaluations.jsonl")))
                .isEqualTo(evaluations.subList((int) dropped, evaluations.size()));
        assertThat(RunReader.recorded(parts).end()).isEqualTo(evaluations.size());
        CompactRun.compact(parts);
        CompactRun.compact(whole);
        assertThat(parts.resolve("checkpoint.json.gz")).hasSameBinaryContentAs(whole.resolve("checkpoint.json.gz"));
    }

    /** What was written first is whole: the kill may come after any of the steps, and before the first new evaluation. */
    @Test
    void aRunThatWasKilledWhileItWasMadeSmallIsSound() throws Exception {
        EvolutionSettings settings = SETTINGS.withSize(8, 2);
        Path run = folder.resolve("run");
        evolve(run, settings);
        byte[] evaluations = Files.readAllBytes(run.resolve("evaluations.jsonl"));
        byte[] checkpoint = Files.readAllBytes(run.resolve("checkpoint.json"));
        CompactRun.compact(run);
        byte[] small = Files.readAllBytes(run.resolve("checkpoint.json"));
        Path whole = folder.resolve("whole");
        evolve(whole, settings.withSize(8, 3));

        for (byte[] state : List.of(checkpoint, small)) {
            Files.write(run.resolve("checkpoint.json"), state);
            Files.write(run.resolve("evaluations.jsonl"), evaluations);
            assertThat(RunReader.in(run).damage()).isNull();
        }
        try (RunWriter opened = RunWriter.open(run)) {
            opened.changeGenerations(3);
            assertThat(RunReader.in(run).damage()).isNull();
        }
        evolve(run, settings.withSize(8, 3));
        for (String name : List.of("checkpoint.json", "evaluations.jsonl", "savings.json")) {
            assertThat(run.resolve(name)).as(name).hasSameTextualContentAs(whole.resolve(name));
        }
    }

    /** The compressed checkpoint is a whole one. */
    @Test
    void goesOnWithoutTheSmallCheckpoint() throws Exception {
        EvolutionSettings settings = SETTINGS.withSize(8, 2);
        Path run = folder.resolve("run");
        Path whole = folder.resolve("whole");
        evolve(run, settings);
        CompactRun.compact(run);
        Files.delete(run.resolve("checkpoint.json"));
        evolve(run, settings.withSize(8, 3));
        evolve(whole, settings.withSize(8, 3));
        assertThat(run.resolve("checkpoint.json")).hasSameTextualContentAs(whole.resolve("checkpoint.json"));
    }

    @Test
    void whatIsNeededToGoOnMayBeGone() throws Exception {
        EvolutionSettings settings = SETTINGS.withSize(8, 2);
        Path old = folder.resolve("old");
        evolve(old, settings);
        CompactRun.compact(old);
        Files.delete(old.resolve("checkpoint.json.gz"));
        assertThatThrownBy(() -> evolve(old, settings.withSize(8, 3))).isInstanceOf(InvalidInputException.class)
                .hasMessage(
                        old + " has no population any more, which it would go on from: it lacks checkpoint.json.gz");

        Path strategy = folder.resolve("strategy");
        EvolutionSettings other = settings.withObjectives(OptimizerKind.CMA_ES, null);
        evolve(strategy, other);
        CompactRun.compact(strategy);
        assertThatThrownBy(() -> evolve(strategy, other.withSize(8, 3))).isInstanceOf(InvalidInputException.class)
                .hasMessage(strategy + " has not all of its evaluations any more, which cma-es would go on from");
    }
}
