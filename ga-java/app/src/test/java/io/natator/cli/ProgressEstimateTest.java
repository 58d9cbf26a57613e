package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.config.Budget;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.OperatorSet;
import io.natator.config.OptimizerKind;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.GenerationSummary;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;

class ProgressEstimateTest {

    private static final EvolutionSettings SETTINGS = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
            .withSize(10, 2);

    private final AtomicLong clock = new AtomicLong();

    private ProgressEstimate estimate(EvolutionSettings settings) {
        return new ProgressEstimate(settings, clock::get);
    }

    private void evaluate(ProgressEstimate estimate, int count, long seconds) {
        for (int i = 0; i < count; i++) {
            estimate.evaluated();
        }
        clock.addAndGet(TimeUnit.SECONDS.toNanos(seconds));
    }

    @Test
    void aTotalThatMayChangeIsSaidToBeOne() {
        ProgressEstimate estimate = estimate(SETTINGS);
        estimate.generationStarted(0, 10);
        assertThat(estimate.total()).isEqualTo("about 44");  // 10 + 2 * 17
        evaluate(estimate, 10, 5);
        assertThat(estimate.rate()).isEqualTo(2.0);

        estimate.generationStarted(1, 19);
        assertThat(estimate.total()).isEqualTo("about 46");  // 10 + 19 + 17
        evaluate(estimate, 19, 9);
        estimate.generationStarted(2, 16);
        assertThat(estimate.total()).isEqualTo("45");
    }

    @Test
    void aLimitIsTheTotalThatMayBeReached() {
        ProgressEstimate both = estimate(SETTINGS.withEvaluations(35L));
        both.generationStarted(0, 10);
        assertThat(both.total()).isEqualTo("at most 35");

        ProgressEstimate alone = estimate(SETTINGS.withSize(10, Budget.NO_LIMIT).withEvaluations(35L));
        alone.generationStarted(0, 10);
        assertThat(alone.total()).isEqualTo("35");

        ProgressEstimate random = estimate(SETTINGS.withOptimizer(OptimizerKind.RANDOM, OperatorSet.CORRECTED, 0.05));
        random.generationStarted(0, 10);
        assertThat(random.total()).isEqualTo("30");
    }

    /** What the run has behind it counts, but not for its speed. */
    @Test
    void aContinuedRunIsCountedFromItsStart() {
        List<GenerationSummary> history = Stream.of(10, 19)
                .map(count -> new GenerationSummary(count / 19, 1, 1, 1, 1, 10, count, 0, 0)).toList();
        ProgressEstimate estimate = new ProgressEstimate(SETTINGS,
                new EvolutionState(1, 29, List.of(), null, history), 29 + 6,
                clock::get);
        assertThat(estimate.done()).isEqualTo(29);
        assertThat(estimate.total()).isEqualTo("about 46");

        estimate.generationStarted(2, 16);
        evaluate(estimate, 6, 2);
        assertThat(estimate.done()).isEqualTo(35);
        assertThat(estimate.total()).isEqualTo("45");
        assertThat(estimate.left()).isEqualTo("?");

        evaluate(estimate, 4, 2);
        assertThat(estimate.rate()).isEqualTo(1.0);
        assertThat(estimate.left()).isEqualTo("6s");
        assertThat(estimate.elapsed()).isEqualTo("4s");
        assertThat(estimate.percent()).isEqualTo(86);
    }

    @Test
    void longTimesAreReadable() {
        assertThat(ProgressEstimate.readable(59)).isEqualTo("59s");
        assertThat(ProgressEstimate.readable(67)).isEqualTo("1m07s");
        assertThat(ProgressEstimate.readable(5040)).isEqualTo("1h24m");
    }
}
