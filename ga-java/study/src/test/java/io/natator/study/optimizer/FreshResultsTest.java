package io.natator.study.optimizer;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.FreshRuns;
import io.natator.checkpoint.SwimSample;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.Judge;
import io.natator.encoding.Gait;
import io.natator.evolution.GenerationSummary;
import io.natator.simulator.SimulationResult;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class FreshResultsTest {

    private static final Gait GAIT = new Gait(1, List.of(0.1), List.of(0.0));
    private static final List<Double> GENES = List.of(1.0);
    private static final List<Double> WORTHS = List.of(0.1, 0.3);

    @TempDir
    private Path folder;

    /** Of two fresh runs, 0.1 and 0.3, whose mean is known to 0.1; what is no larger than that is a share of nothing. */
    @ParameterizedTest
    @CsvSource({"0.4,0.5,true", "0.09,,true", "0.4,0.5,false", "0.09,,false", "0,,false"})
    void aLossIsKnownWhereThereWasSomethingToLose(double selected, Double loss, boolean isByTheRun) {
        SimulationResult result = new SimulationResult(0L, SimulationResult.Status.OK, 0.2, "completed", 4.0, 240, "conserving", "float", null,
                null, null);
        FreshRuns fresh = FreshRuns.of(4, SwimSample.of(List.of(result, result), 4, GAIT, 4.0, 1.25), null, Judge.MEAN, selected, 1, WORTHS);
        BestGait best = new BestGait("thesis/creature-3", GENES, GAIT, null, 0.2, 0.05, result, 1.25, null, selected, 1,
                isByTheRun ? fresh : null);
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-3", EncodingKind.DENSE, 3).withSeed(5);
        RunSummary summary = new RunSummary("random", settings, null, null, best,
                List.of(new GenerationSummary(0, 1, 1, 1, 1, 100, 100, 0, 0)), List.of());
        try (FreshResults results = new FreshResults(folder, "creature-3")) {
            results.add(new FreshGait("random", 5, GENES, WORTHS));

            assertThat(results.loss(new OptimizerRun("creature-3", OptimizerVariant.RANDOM, settings, folder, summary))).isEqualTo(loss);
        }
    }
}
