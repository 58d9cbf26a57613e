package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import org.junit.jupiter.api.Test;

class PaceTest {

    private static final EvolutionSettings SETTINGS =
            EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2).withSize(10, 2);

    private final AtomicLong clock = new AtomicLong();
    private final Pace pace = new Pace(SETTINGS, 0, clock::get);

    private void evaluate(int count, long seconds) {
        for (int i = 0; i < count; i++) {
            pace.evaluated();
        }
        clock.addAndGet(TimeUnit.SECONDS.toNanos(seconds));
    }

    @Test
    void expectsWhatTheLastGenerationTook() {
        pace.generationStarted(0, 10);
        assertThat(pace.left()).isEqualTo("?");
        assertThat(pace.expected()).isEqualTo(10 + 2 * 15);

        evaluate(10, 5);
        pace.generationStarted(1, 20);
        assertThat(pace.rate()).isEqualTo(2.0);
        assertThat(pace.expected()).isEqualTo(10 + 20 + 20);
        assertThat(pace.left()).isEqualTo("20s");
    }

    @Test
    void expectsNoMoreThanTheRunMayTake() {
        Pace limited = new Pace(SETTINGS.withEvaluations(35L), 10, clock::get);

        limited.generationStarted(1, 20);
        assertThat(limited.expected()).isEqualTo(25);
    }

    @Test
    void longTimesAreReadable() {
        pace.generationStarted(0, 10);
        evaluate(1, 130);
        assertThat(pace.left()).isEqualTo("1h24m");
        evaluate(29, 0);
        assertThat(pace.left()).isEqualTo("43s");
        clock.addAndGet(TimeUnit.SECONDS.toNanos(70));
        assertThat(pace.left()).isEqualTo("1m07s");
    }
}
