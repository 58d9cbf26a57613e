package io.natator.study.cluster;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.stream.DoubleStream;
import org.junit.jupiter.api.Test;

/** What a simulated cluster does, beside what follows by hand. */
class ClusterSimulationTest {

    private static final double[] SECOND = {1};

    private static Usage run(Assumptions cluster, Load load, int executors, double... times) {
        return ClusterSimulation.run(cluster, load, executors, times, 1);
    }

    @Test
    void waitsForTheLastEvaluationOfAGeneration() {
        // 10 evaluations on 4 executors take three rounds.
        Usage usage = run(Assumptions.IDEAL, new Load(10, 1, 5), 4, SECOND);

        assertThat(usage.seconds()).isCloseTo(15, within(1e-9));
        assertThat(usage.efficiency()).isCloseTo(10 / 12.0, within(1e-9));
    }

    @Test
    void aDriverHandsOutOneAfterAnother() {
        Assumptions cluster = new Assumptions(0.4, 0.1, 0, 0, 0, 0, 0, 1, false);

        // One evaluation begins every half second, so two executors are busy however many there are.
        assertThat(run(cluster, new Load(20, 1, 1), 100, SECOND).seconds()).isCloseTo(20 * 0.5 + 1, within(1e-9));
        assertThat(run(new Assumptions(0, 0, 0.25, 2, 0, 0, 0, 1, false), new Load(4, 1, 3), 4, SECOND).seconds())
                .isCloseTo(3 * 1.25 + 2 * 2, within(1e-9));
    }

    /** Ten evaluations of 0.1 s on one executor: 5, 2, 1, 1 and 1 of them, each part half a second of the driver. */
    @Test
    void shortEvaluationsGoOutTogether() {
        Assumptions cluster = new Assumptions(0.5, 0, 0, 0, 0, 0, 0, 1, false);

        assertThat(run(cluster, new Load(10, 1, 1), 1, 0.1).seconds()).isCloseTo(5 * 0.5 + 10 * 0.1, within(1e-9));
    }

    @Test
    void severalRunsFillEachOthersGaps() {
        Load load = new Load(10, 8, 5);

        Usage usage = run(Assumptions.IDEAL, load, 4, SECOND);

        assertThat(usage.efficiency()).isGreaterThan(0.97);
        assertThat(usage.seconds() * 4 * usage.efficiency()).isCloseTo(8 * 5 * 10, within(1e-6));
    }

    @Test
    void slowExecutorsAreOvertaken() {
        Assumptions slow = new Assumptions(0, 0, 0, 0, 0, 0, 0.01, 100, false);
        Load load = new Load(300, 1, 3);

        Usage without = run(slow, load, 100, SECOND);
        Usage with = run(slow.withSpeculation(true), load, 100, SECOND);

        assertThat(without.seconds()).isCloseTo(300, within(1e-9));
        assertThat(with.copies()).isEqualTo(3);
        // After the limit of 10 s another one takes a second; the slow one is then free for the next generation.
        assertThat(with.seconds()).isCloseTo(3 * 11, within(1e-9));
    }

    @Test
    void whatFailsIsDoneAgain() {
        Assumptions failing = new Assumptions(0, 0, 0, 0, 180, 10, 0, 1, false);
        Load load = new Load(200, 2, 5);

        Usage usage = run(failing, load, 20, 2);

        // One in ten is lost, after a second in the mean; an executor is away for a third of the time.
        double busy = usage.seconds() * 20 * usage.efficiency();
        assertThat(busy).as("every evaluation counts once").isCloseTo(4000, within(1e-6));
        assertThat(usage.lost()).isBetween(150L, 260L);
        assertThat(usage.efficiency()).isBetween(0.5, 0.7);
    }

    @Test
    void theSameSeedGivesTheSameOutcome() {
        Assumptions cluster = new Assumptions(0.001, 0.001, 0.01, 0.1, 30, 5, 0.1, 3, true);
        double[] times = DoubleStream.iterate(0.2, each -> each * 1.1).limit(20).toArray();

        assertThat(ClusterSimulation.run(cluster, new Load(150, 3, 4), 40, times, 7))
                .isEqualTo(ClusterSimulation.run(cluster, new Load(150, 3, 4), 40, times, 7))
                .isNotEqualTo(ClusterSimulation.run(cluster, new Load(150, 3, 4), 40, times, 8));
    }
}
