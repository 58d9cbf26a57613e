package io.natator.verdict;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.FreshRuns;
import io.natator.checkpoint.SwimSample;
import io.natator.protocol.Results;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SwimmingNumbers;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class WinnerFactsTest {

    @TempDir
    private Path run;

    private static SimulationResult result(double distance) {
        return result(distance, null);
    }

    private static SimulationResult result(double distance, Double across) {
        return Results.ok(distance).withWork(3.0)
                .withSwimming(new SwimmingNumbers(0.2, 0.31, 131.4, 410.0, distance / 10, across));
    }

    private static BestGait best(FreshRuns fresh) {
        return Winners.best("pool/creature-1", result(2.5), 1.25, result(0), fresh);
    }

    /** Whether it swims, how fast, how sure, what it lost since it was selected, and what it costs. */
    @Test
    void aReaderOfAWinnerIsToldAll() {
        FreshRuns fresh = Winners.fresh(Winners.sample(List.of(result(1.9), result(2.1))),
                Winners.sample(List.of(result(1.8), result(1.8))), 2.5, 2.0);

        assertThat(WinnerFacts.of(run, best(fresh))).containsExactly(
                Map.entry("verdict", "swims: 0.40 ± 0.03 body lengths/s, 0.36 at half the time step, 0.00 in vacuum"),
                Map.entry("speed", "0.5000 ± 0.0354 units/s, 0.400 ± 0.028 body lengths/s, 0.200 ± 0.014 per beat"),
                Map.entry("distance", "2.0000 ± 0.1414 in 4.00 s; 2 fresh starts, all completed"),
                Map.entry("half step", "1.8000 ± 0.0000 at half the time step; 2 fresh starts, all completed; "
                        + "0.360 ± 0.000 body lengths/s"),
                Map.entry("selected", "2.5000 by one run, 2.0000 again: selection loss 20.0 %"),
                Map.entry("cost", "cost of transport 1.5 mass · length/s², work of the muscles 3 mass · length²/s²"),
                Map.entry("flow", "Reynolds number 131, Strouhal number 0.31, cavities in the water 0.2 body volumes"));
    }

    @Test
    void oneRunIsSaidToBeOne() {
        assertThat(WinnerFacts.of(run, best(null))).containsOnlyKeys("verdict", "cost", "flow")
                .containsEntry("verdict", "swims: 0.50 body lengths/s, 0.00 in vacuum (one run, not a mean)")
                .containsEntry("cost",
                        "cost of transport 1.2 mass · length/s², work of the muscles 3 mass · length²/s²");
    }

    /** A body that the water is too coarse for is said to be, of one run and of fresh ones; what has no number of it, or enough, is not. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', nullValues = "-", value = {"1.5|, body 1.5 spacings of the water across",
            "3.98|, body 4 spacings of the water across", "0.5|, body 0.5 spacings of the water across",
            "4|-", "3.999999|-", "9|-", "0|-", "-|-"})
    void coarseWaterIsTold(Double across, String told) {
        SimulationResult one = result(2.0, across);
        SwimSample sample = Winners.sample(List.of(one));
        FreshRuns fresh = Winners.fresh(sample, sample, 2.5, 2.0);
        String flow = "Reynolds number 131, Strouhal number 0.31, cavities in the water 0.2 body volumes"
                + (told == null ? "" : told);
        for (FreshRuns runs : Arrays.asList(null, fresh)) {
            BestGait best = Winners.best("pool/creature-1", one, 1.25, result(0), runs);
            assertThat(WinnerFacts.mechanics(best)).containsEntry("flow", flow);
        }
    }
}
