package io.natator.run;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.checkpoint.Leader;
import io.natator.checkpoint.RunReader;
import io.natator.checkpoint.RunWriter;
import io.natator.config.Aggregate;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.evolution.ToySimulator;
import io.natator.process.Evaluator;
import io.natator.process.FakePool;
import io.natator.process.FakeSimulator;
import io.natator.protocol.SimulationResult;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** Whom a run would have taken for its winner, had it ended earlier. */
class LeadersTest {

    @TempDir
    private Path folder;

    /** The toy swimmer, who touches a wall after 1 s of 4 if it is quick. */
    private static FakePool.Simulation hurried() {
        FakePool.Simulation toy = new ToySimulator();
        return request -> {
            SimulationResult one = toy.evaluate(request);
            return one.distance() < 0.2 ? one : one.with(to -> to.stopped("touched-plane").simulated(1.0).frames(60));
        };
    }

    @ParameterizedTest
    @CsvSource({"1, 1", "1, 2", "3, 1", "3, 2", "4, 3"})
    void theLastLeaderIsTheWinner(int starts, long seed) throws InterruptedException {
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2).withSize(20, 8)
                .withStarts(starts, Aggregate.MEAN).withSeed(seed);
        ExecutionSettings how = FakeSimulator.execution(folder);
        try (RunWriter run = RunWriter.create(folder.resolve("run"), settings);
                Evaluator pool = new FakePool(hurried(), 2)) {
            new EvolutionRun(run).run(how, pool);
        }
        RunReader run = RunReader.in(folder.resolve("run"));

        List<Leader> leaders = run.leaders();

        Leader last = leaders.get(leaders.size() - 1);
        assertThat(last.genes()).isEqualTo(run.best().genes());
        assertThat(last.worth()).isCloseTo(run.best().selected(), within(1e-12));
        assertThat(run.bestWorth()).hasSize(run.evaluations().size()).endsWith(last.worth());
        assertThat(leaders).extracting(Leader::evaluation).isSorted().doesNotHaveDuplicates();
        for (Leader one : leaders) {
            double until = run.evaluations().subList(0, one.evaluation() + 1).stream()
                    .mapToDouble(done -> done.result().distance() < 0.2 ? 4 : 1).sum();
            assertThat(one.simulated()).isEqualTo(until);
        }
        assertThat(run.evaluations().get(leaders.get(0).evaluation()).result().id()).isEqualTo(starts - 1L);
        assertThat(run.statistics().simulatedSeconds()).isLessThan(run.statistics().wholeSeconds());
    }
}
