package io.natator.checkpoint;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.verdict.FreshText;
import io.natator.verdict.Winners;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class FreshRunsTest {

    /** Of two fresh runs, 0.1 and 0.3, whose mean is known to 0.1; what is no larger than that is a share of nothing. */
    @ParameterizedTest
    @CsvSource(delimiter = '|',
            value = {"0.4|0.4000 by one run, 0.2000 again: selection loss 50.0 %",
                    "0.09|0.0900 by one run, 0.2000 again",
                    "0|0.0000 by one run, 0.2000 again", "-0.4|-0.4000 by one run, 0.2000 again"})
    void aLossIsToldWhereThereWasSomethingToLose(double selected, String text) {
        SwimSample base = Winners.sample(0.2, 0.2);
        BestGait best = Winners.best(Winners.fresh(base, null, selected, 0.1, 0.3), 0);

        assertThat(FreshText.of(best).get("selected")).isEqualTo(text);
    }
}
