package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.api.Test;

class GenerationSummaryTest {

    @Test
    void summarisesSignedDistances() {
        GenerationSummary summary = GenerationSummary.of(3, new double[] {0.5, -1.0, 0.0, 0.25}, 2, 1, 0);

        assertThat(summary).isEqualTo(new GenerationSummary(3, 0.5, -0.0625, 0.125, -1.0, 4, 2, 1, 0));
    }

    @Test
    void medianOfAnOddNumberIsTheMiddleOne() {
        assertThat(GenerationSummary.of(0, new double[] {3, 1, 2}, 3, 0, 0).median()).isEqualTo(2.0);
    }

    @Test
    void doesNotReorderWhatItIsGiven() {
        double[] distances = {3, 1, 2};

        GenerationSummary.of(0, distances, 3, 0, 0);

        assertThat(distances).containsExactly(3, 1, 2);
    }

    @Test
    void needsAChromosome() {
        assertThatThrownBy(() -> GenerationSummary.of(0, new double[0], 0, 0, 0))
                .hasMessage("generation 0 has no chromosomes");
    }
}
