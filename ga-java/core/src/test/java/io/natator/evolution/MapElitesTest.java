package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.natator.base.InvalidInputException;
import io.natator.config.Aggregate;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.config.OptimizerKind;
import io.natator.encoding.Encoding;
import io.natator.encoding.Gait;
import io.natator.process.FakePool;
import io.natator.protocol.Effort;
import io.natator.protocol.Results;
import java.util.List;
import java.util.SortedMap;
import org.junit.jupiter.api.Test;

class MapElitesTest {

    private static final Encoding ENCODING = EncodingKind.DENSE.forActuators(2);
    private static final EvolutionSettings SETTINGS = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
            .withSize(30, 12).withSeed(2).withObjectives(OptimizerKind.MAP_ELITES, null);

    @Test
    void theMapFillsAndNoEliteGetsWorse() {
        List<EvolutionState> states = ToyEvolution.run(SETTINGS).states;

        SortedMap<EliteMap.Cell, Individual> before = new EliteMap(List.of()).elites();
        for (EvolutionState state : states) {
            SortedMap<EliteMap.Cell, Individual> now = new EliteMap(state.population()).elites();
            assertThat(now).as("one individual for each cell").hasSize(state.population().size());
            before.forEach((cell, elite) -> assertThat(now.get(cell).score()).isGreaterThanOrEqualTo(elite.score()));
            before = now;
        }
        int first = states.get(0).population().size();
        assertThat(states.get(12).population().size()).isGreaterThan(2 * first);
        assertThat(states.get(12).best().score()).isGreaterThan(states.get(0).best().score()).isGreaterThan(0.45);
    }

    /** By what the simulated body did in its 4 s, not by what its gait asks for. */
    @Test
    void cellsAreByWhatWasMeasured() {
        SortedMap<EliteMap.Cell, Individual> elites = new EliteMap(ToyEvolution.run(SETTINGS).end().population())
                .moving();

        assertThat(elites).hasSizeGreaterThan(20);
        elites.forEach((cell, elite) -> {
            Gait gait = ENCODING.decode(elite.genes());
            double way = Math.abs(ToySimulator.distance(gait));
            assertThat(4 * gait.frequency() / (way / ToyEvolution.BODY_LENGTH)).isBetween(end(cell.beats(), 0),
                    end(cell.beats(), 1));
            assertThat(ToySimulator.work(gait) / way).isBetween(end(cell.cost(), 0), end(cell.cost(), 1));
        });
    }

    /** An end of a cell, with room for rounding outwards. */
    private static double end(int cell, int which) {
        return Math.pow(2, (cell + which) / 2.0) * (1 + (2 * which - 1) * 1e-9);
    }

    @Test
    void whatGetsNowhereIsOneKind() {
        assertThat(EliteMap.cell(new Effort(8, 1, 2, 12))).isEqualTo(new EliteMap.Cell(6, 5));
        assertThat(EliteMap.cell(new Effort(8, -1, -2, 12))).as("backwards").isEqualTo(new EliteMap.Cell(6, 5));
        assertThat(EliteMap.edge(6)).isEqualTo(8);
        assertThat(EliteMap.cell(new Effort(8, 8, 8, 0.6))).as("below 1").isEqualTo(new EliteMap.Cell(0, -8));
        assertThat(List.of(new Effort(8, 0.06, 0.1, 3), new Effort(8, 0, 0, 3), new Effort(8, 1, 1, 0),
                new Effort(8, 0, 0, 0)))
                .allSatisfy(effort -> assertThat(EliteMap.cell(effort)).isEqualTo(EliteMap.Cell.NOWHERE));
    }

    /** Of several starts a gait is of the kind of all its runs together, those in races too. */
    @Test
    void kindsAreByAllRuns() {
        ToyEvolution.Recorder recorder = ToyEvolution
                .run(SETTINGS.withSize(20, 4).withStarts(3, Aggregate.MEAN));

        assertThat(recorder.end().champions()).isNotEmpty().allSatisfy(one -> {
            List<EvaluationRecord> own = recorder.evaluations.stream().filter(run -> run.genes().equals(one.genes()))
                    .toList();
            assertThat(own).hasSizeGreaterThan(3);
            assertThat(one.effort().distance())
                    .isCloseTo(own.stream().mapToDouble(run -> run.result().distance()).sum(), within(1e-12));
            assertThat(one.effort().beats()).isCloseTo(4 * own.size() * ENCODING.decode(one.genes()).frequency(),
                    within(1e-9));
            assertThat(one.effort().work()).isCloseTo(own.size() * ToySimulator.work(ENCODING.decode(one.genes())),
                    within(1e-9));
        });
        assertThat(Json.line(recorder.end())).contains("\"effort\":{\"beats\":");
    }

    /** As scheme flex, which cannot tell what its muscles do. */
    @Test
    void withoutWorkThereAreNoKinds() {
        FakePool.Simulation flex = request -> Results.ok(request.id(), 1.0).withScheme("flex");
        assertThatThrownBy(() -> ToyEvolution.run(SETTINGS, flex)).isInstanceOf(InvalidInputException.class)
                .hasMessageStartingWith(
                        "optimizer map-elites: this simulator does not measure the muscles' work in scheme flex");
    }

    /** A run by a version whose kinds were others does not go on as if its map were empty. */
    @Test
    void anotherVersionsMapIsNoMap() {
        EvolutionState state = ToyEvolution.run(SETTINGS.withSize(20, 1)).states.get(0);
        List<Individual> old = state.population().stream()
                .map(one -> new Individual(one.genes(), one.age(), one.result().withEffort(null))).toList();

        assertThatThrownBy(() -> new EliteMap(old)).isInstanceOf(EvolutionFailedException.class)
                .hasMessageContaining("another version");
    }
}
