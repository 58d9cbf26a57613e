package io.natator.checkpoint;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.config.Aggregate;
import io.natator.encoding.Gait;
import io.natator.protocol.SimulationResult;
import io.natator.verdict.FreshText;
import java.util.List;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class FreshRunsTest {

    private static final Gait GAIT = new Gait(1, List.of(0.1), List.of(0.0));

    /** Of two fresh runs, 0.1 and 0.3, whose mean is known to 0.1; what is no larger than that is a share of nothing. */
    @ParameterizedTest
    @CsvSource(delimiter = '|',
            value = {"0.4|0.4000 by one run, 0.2000 again: selection loss 50.0 %",
                    "0.09|0.0900 by one run, 0.2000 again",
                    "0|0.0000 by one run, 0.2000 again", "-0.4|-0.4000 by one run, 0.2000 again"})
    void aLossIsToldWhereThereWasSomethingToLose(double selected, String text) {
        SimulationResult result = new SimulationResult(0L, SimulationResult.Status.OK, 0.2, "completed", 4.0, 240,
                "conserving", "float", null,
                null, null);
        FreshRuns fresh = FreshRuns.of(4, SwimSample.of(List.of(result, result), 4, GAIT, 4.0, 1.25), null,
                Aggregate.MEAN, selected, 1,
                List.of(0.1, 0.3));
        BestGait best = new BestGait("pool/creature-1", List.of(1.0), GAIT, null, 0.2, 0.05, result, 1.25, null,
                selected, 1, fresh);

        assertThat(FreshText.of(best).get("selected")).isEqualTo(text);
    }
}
