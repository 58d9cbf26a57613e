package io.natator.checkpoint;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.evolution.ToySimulator;
import io.natator.run.EvolutionRun;
import io.natator.simulator.Evaluator;
import io.natator.simulator.FakeSimulator;
import io.natator.simulator.WorkerPool;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class CompactRunTest {

    @TempDir
    private Path folder;

    @Test
    void aCompactRunIsStillFinishedAndHasItsResults() throws Exception {
        Path directory = folder.resolve("run");
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2).withSize(8, 3);
        ExecutionSettings execution = new ExecutionSettings(FakeSimulator.in(folder), 2, Duration.ofMinutes(5));
        try (RunFolder run = RunFolder.create(directory, settings);
                Evaluator evaluator = new WorkerPool(new ToySimulator(), 2)) {
            assertThatThrownBy(() -> CompactRun.compact(directory)).isInstanceOf(InvalidInputException.class)
                    .hasMessageContaining("not a finished run");
            new EvolutionRun(run).run(execution, evaluator);
        }
        StoredRun before = StoredRun.in(directory);
        assertThat(before.evaluations()).isNotEmpty();

        CompactRun.compact(directory);
        CompactRun.compact(directory);

        assertThat(StoredRun.isFinished(directory)).isTrue();
        StoredRun after = StoredRun.in(directory);
        assertThat(after.best()).isEqualTo(before.best());
        assertThat(after.state().history()).isEqualTo(before.state().history());
        assertThat(after.state().evaluations()).isEqualTo(before.evaluations().size());
        assertThat(after.evaluations()).isEmpty();
        assertThat(Files.size(directory.resolve("checkpoint.json"))).isLessThan(5000);
    }
}
