package io.natator.study.thesis;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.checkpoint.StoredRun;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.config.Scheme;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class EvolutionPlanTest {

    private static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize();
    private static final Path STUDY = Path.of("../../results/thesis");
    private static final Path FINISHED = STUDY.resolve("runs/creature-1/flex/seed-1");
    private static final EvolutionPlan.Size SIZE = new EvolutionPlan.Size(null, 7, null, null);

    @TempDir
    private Path folder;

    private EvolutionPlan plan(Integer seeds) throws InterruptedException {
        return new EvolutionPlan(List.of(1, 2), List.of(Water.values()), seeds, SIZE, Backend.CPU, SIMULATOR, folder);
    }

    private final int generations = StoredRun.settings(FINISHED).generations();

    private void hold(String run, String... names) throws IOException {
        Path copy = Files.createDirectories(folder.resolve("runs").resolve(run));
        for (String name : names) {
            Files.copy(FINISHED.resolve(name), copy.resolve(name));
        }
    }

    private static String seeds(EvolutionPlan plan, Water water) {
        return plan.runs().stream().filter(run -> run.water() == water).map(run -> run.creature() + "/" + run.seed()).toList().toString();
    }

    @Test
    void thereAreThreeWhereNothingIs() throws InterruptedException {
        for (Water water : Water.values()) {
            assertThat(seeds(plan(null), water)).isEqualTo("[1/1, 2/1, 1/2, 2/2, 1/3, 2/3]");
            assertThat(plan(null).extents()).containsEntry(water, new EvolutionPlan.Extent(3, 7));
        }
        assertThat(plan(null).begun()).hasSize(12);
    }

    /** The largest of any creature, in each water; what is not finished counts as little as a creature that was not asked for. */
    @Test
    void whatAFolderHoldsIsKept() throws InterruptedException, IOException {
        hold("creature-1/flex/seed-1", "config.json", "checkpoint.json", "best.json");
        hold("creature-1/flex/seed-4", "config.json", "checkpoint.json", "best.json");
        hold("creature-2/flex/seed-5", "config.json", "checkpoint.json", "best.json");
        hold("creature-1/flex/seed-6", "config.json");
        hold("creature-1/flex/seed-07", "config.json", "checkpoint.json", "best.json");
        hold("creature-3/flex/seed-8", "config.json", "checkpoint.json", "best.json");
        hold("creature-1/open-water/seed-2", "config.json", "checkpoint.json", "best.json");

        EvolutionPlan plan = plan(null);
        assertThat(seeds(plan, Water.FLEX)).isEqualTo("[1/1, 2/1, 1/2, 2/2, 1/3, 2/3, 1/4, 2/4, 1/5, 2/5]");
        assertThat(seeds(plan, Water.OPEN_WATER)).as("the same command goes on until there are three")
                .isEqualTo("[1/1, 2/1, 1/2, 2/2, 1/3, 2/3]");
        assertThat(plan.finished()).hasSize(4);
        assertThat(plan.extents()).containsEntry(Water.FLEX, new EvolutionPlan.Extent(5, generations))
                .containsEntry(Water.OPEN_WATER, new EvolutionPlan.Extent(2, generations));
        assertThat(plan.begun()).as("5 and 2 of 2 creatures").hasSize(14);
    }

    /** What goes on is asked for; otherwise further seeds have as many as the first. */
    @Test
    void soManyGenerationsAsThereAreAreUsual() throws InterruptedException, IOException {
        hold("creature-1/flex/seed-1", "config.json", "checkpoint.json", "best.json");

        EvolutionPlan usual = new EvolutionPlan(List.of(1, 2), List.of(Water.FLEX), 2, new EvolutionPlan.Size(null, null, null, null), Backend.CPU,
                SIMULATOR, folder);
        assertThat(usual.runs().stream().map(run -> run.plan().settings().generations())).as("1/1, 2/1, 1/2, 2/2")
                .containsExactly(generations, 25, generations, 25);
        assertThat(usual.finished()).hasSize(1);

        EvolutionPlan more = new EvolutionPlan(List.of(1), List.of(Water.FLEX), 1, new EvolutionPlan.Size(null, generations + 1, null, null),
                Backend.CUDA, SIMULATOR, folder);
        assertThat(more.finished()).as("it is to go on").isEmpty();
    }

    /** An evolution goes on as it was begun, also where newer ones search otherwise. */
    @Test
    void theSearchIsTheFolders() throws InterruptedException, IOException {
        hold("creature-1/flex/seed-1", "config.json", "checkpoint.json", "best.json");
        Path config = folder.resolve("runs/creature-1/flex/seed-1/config.json");
        EvolutionSettings begun = StoredRun.settings(config.getParent()).withSize(20, generations)
                .withScene(Scheme.FLEX, 1.5, Json.parse("{\"fluid\": {\"count\": [10, 11, 12]}, \"solver\": {\"gravity\": [0, -4.8, 0]}}", JsonNode.class));
        Files.writeString(config, Json.document(begun));

        EvolutionSettings planned = plan(2).runs().get(0).plan().settings();
        assertThat(planned).isEqualTo(begun.withBackend(Backend.CPU).withSize(20, 7).withSeed(1));
    }

    /** Numbers of a search are of the types that a run folder gives back: it could not go on otherwise. */
    @Test
    void searchesReadBackAsTheyWere() throws IOException {
        for (Water water : Water.values()) {
            for (int creature = 1; creature <= 4; creature++) {
                JsonNode search = water.evolving(creature).overrides();
                assertThat(search == null ? null : Json.parse(Json.line(search), JsonNode.class)).isEqualTo(search);
            }
        }
    }

    /** The study's one command makes in an empty folder what is committed. */
    @Test
    void whatIsCommittedWasEvolvedAsItWouldBeAnew() throws InterruptedException {
        EvolutionPlan anew = new EvolutionPlan(List.of(1, 2, 3, 4), List.of(Water.values()), 5,
                new EvolutionPlan.Size(null, 100, null, null), Backend.CUDA, SIMULATOR, folder);

        assertThat(anew.runs()).hasSize(40).allSatisfy(run -> assertThat(run.plan().settings())
                .isEqualTo(StoredRun.settings(STUDY.resolve(folder.relativize(run.plan().directory())))));
    }

    @Test
    void whatIsAskedForCounts() throws InterruptedException, IOException {
        hold("creature-1/flex/seed-4", "config.json", "checkpoint.json", "best.json");

        assertThat(seeds(plan(2), Water.FLEX)).isEqualTo("[1/1, 2/1, 1/2, 2/2]");
        assertThat(plan(6).runs()).hasSize(24);
        assertThat(plan(6).extents()).containsEntry(Water.FLEX, new EvolutionPlan.Extent(4, generations))
                .containsEntry(Water.OPEN_WATER, new EvolutionPlan.Extent(6, 7));
    }
}
