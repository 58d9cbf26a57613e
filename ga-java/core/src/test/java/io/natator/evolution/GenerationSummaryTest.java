package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.protocol.Results;
import io.natator.protocol.SimulationResult;
import java.util.List;
import java.util.stream.Stream;
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

    private static Individual swim(double distance) {
        return new Individual(List.of(0.5), 0, Results.ok(1, distance));
    }

    private static Individual failed() {
        return new Individual(List.of(0.6), 0, SimulationResult.failed(2, "no answer"));
    }

    @Test
    void whatFailedHasNoDistance() {
        assertThat(GenerationSummary.of(0, List.of(swim(0.5), swim(-1.5), failed()), 3, 0, 1))
                .isEqualTo(new GenerationSummary(0, 0.5, -1.0 / 3, 0, -1.5, 3, 3, 0, 1));
    }

    /** What it is worth by objectives is not as a swim is, and among worths below 0 a 0 would be the best. */
    @Test
    void whatFailedIsLeftOutAmongOtherWorths() {
        List<Individual> population = Stream.of(swim(-0.5), swim(-1.5), failed())
                .map(one -> new Individual(one.genes(), 0,
                        one.result().withWorth(List.of(0.0), one.isMeasured() ? one.score() : -200000)))
                .toList();

        assertThat(GenerationSummary.of(0, population, 3, 0, 1))
                .isEqualTo(new GenerationSummary(0, -0.5, -1, -1, -1.5, 3, 3, 0, 1));
    }

    @Test
    void needsAChromosome() {
        assertThatThrownBy(() -> GenerationSummary.of(0, new double[0], 0, 0, 0))
                .hasMessage("generation 0 has no chromosomes");
    }
}
