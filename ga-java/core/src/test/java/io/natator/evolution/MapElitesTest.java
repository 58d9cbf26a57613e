package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.OptimizerKind;
import io.natator.encoding.Encoding;
import io.natator.encoding.Gait;
import io.natator.simulator.WorkerPool;
import java.util.ArrayList;
import java.util.List;
import java.util.SortedMap;
import org.junit.jupiter.api.Test;

class MapElitesTest {

    private static final Encoding ENCODING = EncodingKind.DENSE.forActuators(2);
    private static final EvolutionSettings SETTINGS = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
            .withSize(30, 12).withSeed(2).withObjectives(OptimizerKind.MAP_ELITES, null);

    private static List<EvolutionState> run(EvolutionSettings settings) {
        List<EvolutionState> states = new ArrayList<>();
        try (WorkerPool pool = new WorkerPool(new ToySimulator(), 2)) {
            new Evolution(settings, pool, List.of(new EvolutionListener() {
                @Override
                public void generationFinished(EvolutionState state) {
                    states.add(state);
                }
            }), List.of()).run(null);
        }
        return states;
    }

    @Test
    void theMapFillsAndNoEliteGetsWorse() {
        List<EvolutionState> states = run(SETTINGS);

        SortedMap<EliteMap.Cell, Individual> before = new EliteMap(SETTINGS, List.of()).elites();
        for (EvolutionState state : states) {
            SortedMap<EliteMap.Cell, Individual> now = new EliteMap(SETTINGS, state.population()).elites();
            assertThat(now).as("one individual for each cell").hasSize(state.population().size());
            before.forEach((cell, elite) -> assertThat(now.get(cell).score()).isGreaterThanOrEqualTo(elite.score()));
            before = now;
        }
        int first = states.get(0).population().size();
        assertThat(states.get(12).population().size()).isGreaterThan(2 * first);
        assertThat(states.get(12).best().score()).isGreaterThan(states.get(0).best().score()).isGreaterThan(0.45);
    }

    /** Cells are those of the elites' gaits: beats from 0.5 to 2 per second, waves from -1/2 to 1/2 of two actuators. */
    @Test
    void cellsAreByWavesAndBeats() {
        new EliteMap(SETTINGS, run(SETTINGS).get(12).population()).elites().forEach((cell, elite) -> {
            Gait gait = ENCODING.decode(elite.genes());
            assertThat(EliteMap.waves(gait)).isBetween(-0.5 + cell.wave() / 12.0 - 1e-9, -0.5 + (cell.wave() + 1) / 12.0 + 1e-9);
            assertThat(gait.frequency()).isBetween(0.5 + 0.125 * cell.beat() - 1e-9, 0.5 + 0.125 * (cell.beat() + 1) + 1e-9);
        });
    }

    @Test
    void wavesAreTheSumOfTheShorterDelays() {
        Gait travelling = new Gait(1, List.of(1.0, 1.0, 1.0, 1.0), List.of(0.75, 0.0, 0.25, 0.5));
        assertThat(EliteMap.waves(travelling)).isCloseTo(0.75, within(1e-12));
        assertThat(EliteMap.waves(new Gait(1, List.of(1.0, 1.0), List.of(0.1, 0.9)))).isCloseTo(-0.2, within(1e-12));
        assertThat(EliteMap.waves(new Gait(1, List.of(1.0), List.of(0.1)))).isZero();
    }
}
