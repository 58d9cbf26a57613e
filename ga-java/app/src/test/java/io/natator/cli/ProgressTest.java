package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.encoding.Gait;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.GenerationSummary;
import io.natator.evolution.Individual;
import io.natator.protocol.Results;
import java.io.ByteArrayOutputStream;
import java.io.PrintStream;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import org.junit.jupiter.api.Test;

class ProgressTest {

    private static final EvolutionSettings SETTINGS = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
            .withSize(10, 2);
    private static final EvolutionState BEFORE = new EvolutionState(1, 29, List.of(),
            new Individual(List.of(), 1, Results.ok(7, 0.25)),
            List.of(new GenerationSummary(0, 0, 0, 0, 0, 10, 10, 0, 0),
                    new GenerationSummary(1, 0, 0, 0, 0, 29, 19, 0, 0)));

    private final AtomicLong clock = new AtomicLong();
    private final StringWriter out = new StringWriter();

    private void evaluate(Progress progress, double distance, long seconds) {
        clock.addAndGet(TimeUnit.SECONDS.toNanos(seconds));
        progress.evaluated(
                new EvaluationRecord(0, List.of(), new Gait(1, List.of(0.5), List.of(0.0)),
                        Results.ok(distance), null));
    }

    private Progress progress(EvolutionState from, long recorded, PrintStream terminal) {
        return new Progress(SETTINGS, from, recorded, new PrintWriter(out), terminal, clock::get);
    }

    @Test
    void theFirstGenerationIsToldOfWhileItGoesOn() {
        try (Progress progress = progress(null, 0, null)) {
            progress.generationStarted(0, 10);
            evaluate(progress, -0.00001, 9);
            assertThat(out.toString()).isEmpty();
            evaluate(progress, -1, 1);
        }
        assertThat(out.toString().strip())
                .isEqualTo("generation 0 of 2 under way, best 0.0000, evaluations 2 of about 44, "
                        + "elapsed 10s, left 3m30s");
    }

    @Test
    void aContinuedRunGoesOnWhereItWas() {
        try (Progress progress = progress(BEFORE, 29, null)) {
            progress.generationStarted(2, 16);
            evaluate(progress, 0.1, 12);
        }
        assertThat(out.toString().strip()).isEqualTo("generation 2 of 2 under way, best 0.2500, evaluations 30 of 45, "
                + "elapsed 12s, left 3m00s");
    }

    @Test
    void onATerminalTheSameIsInOneLine() {
        ByteArrayOutputStream terminal = new ByteArrayOutputStream();
        try (Progress progress = progress(BEFORE, 29, new PrintStream(terminal, true, StandardCharsets.UTF_8))) {
            progress.generationStarted(2, 16);
            evaluate(progress, 0.5, 12);
        }
        assertThat(out.toString()).isEmpty();
        assertThat(terminal.toString(StandardCharsets.UTF_8)).contains(
                " 66 % [======    ] generation 2 of 2, best 0.5000, evaluations 30 of 45, elapsed 12s, left 3m00s");
    }
}
