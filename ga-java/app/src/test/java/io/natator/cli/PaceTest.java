package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.evolution.GenerationSummary;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.OperatorSet;
import io.natator.config.OptimizerKind;
import io.natator.evolution.EvolutionState;
import java.util.Arrays;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;

class PaceTest {

    private static final EvolutionSettings SETTINGS =
            EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2).withSize(10, 2);

    private final AtomicLong clock = new AtomicLong();

    private Pace pace(EvolutionSettings settings) {
        return new Pace(settings, clock::get);
    }

    private void evaluate(Pace pace, int count, long seconds) {
        for (int i = 0; i < count; i++) {
            pace.evaluated();
        }
        clock.addAndGet(TimeUnit.SECONDS.toNanos(seconds));
    }

    private static EvolutionState after(int... evaluations) {
        List<GenerationSummary> history = IntStream.range(0, evaluations.length)
                .mapToObj(i -> new GenerationSummary(i, 1, 1, 1, 1, 10, evaluations[i], 0, 0)).toList();
        return new EvolutionState(evaluations.length - 1, Arrays.stream(evaluations).sum(), List.of(), null,
                history);
    }

    @Test
    void aTotalThatMayChangeIsSaidToBeOne() {
        Pace pace = pace(SETTINGS);
        pace.generationStarted(0, 10);
        assertThat(pace.total()).isEqualTo("about 40");  // 10 + 2 * 17, in tens
        evaluate(pace, 10, 5);
        assertThat(pace.rate()).isEqualTo(2.0);

        pace.generationStarted(1, 19);
        assertThat(pace.total()).isEqualTo("about 50");  // 10 + 19 + (4 * 17 + 19) / 5, in tens
        evaluate(pace, 19, 9);
        pace.generationStarted(2, 16);
        assertThat(pace.total()).isEqualTo("45");
    }

    /** However many children single generations have. */
    @Test
    void theTotalHardlyWanders() {
        EvolutionSettings settings = SETTINGS.withSize(24, 8);
        Pace pace = pace(settings);
        List<Integer> needs = List.of(24, 36, 48, 42, 39, 45, 37, 44, 41);
        for (int generation = 0; generation < 9; generation++) {
            pace.generationStarted(generation, needs.get(generation));
            assertThat(pace.expected()).isBetween(340L, 360L);
            evaluate(pace, needs.get(generation), 1);
        }
        assertThat(pace.done()).isEqualTo(pace.expected()).isEqualTo(356);
        assertThat(pace.percent()).isEqualTo(100);
    }

    @Test
    void aLimitIsTheTotalThatMayBeReached() {
        Pace both = pace(SETTINGS.withEvaluations(35L));
        both.generationStarted(0, 10);
        assertThat(both.total()).isEqualTo("at most 35");

        Pace alone = pace(SETTINGS.withSize(10, EvolutionSettings.NO_LIMIT).withEvaluations(35L));
        alone.generationStarted(0, 10);
        assertThat(alone.total()).isEqualTo("35");

        Pace random = pace(SETTINGS.withOptimizer(OptimizerKind.RANDOM, OperatorSet.CORRECTED, 0.05));
        random.generationStarted(0, 10);
        assertThat(random.total()).isEqualTo("30");
    }

    /** What the run has behind it counts, but not for its speed. */
    @Test
    void aContinuedRunIsCountedFromItsStart() {
        Pace pace = new Pace(SETTINGS, after(10, 19), 29 + 6, clock::get);
        assertThat(pace.done()).isEqualTo(29);
        assertThat(pace.total()).isEqualTo("about 50");

        pace.generationStarted(2, 16);
        evaluate(pace, 6, 2);
        assertThat(pace.done()).isEqualTo(35);
        assertThat(pace.total()).isEqualTo("45");
        assertThat(pace.left()).isEqualTo("?");

        evaluate(pace, 4, 2);
        assertThat(pace.rate()).isEqualTo(1.0);
        assertThat(pace.left()).isEqualTo("6s");
        assertThat(pace.elapsed()).isEqualTo("4s");
        assertThat(pace.percent()).isEqualTo(86);
    }

    @Test
    void longTimesAreReadable() {
        assertThat(Pace.readable(59)).isEqualTo("59s");
        assertThat(Pace.readable(67)).isEqualTo("1m07s");
        assertThat(Pace.readable(5040)).isEqualTo("1h24m");
    }
}
