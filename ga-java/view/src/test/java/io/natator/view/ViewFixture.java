package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.Natator;
import io.natator.config.BodyEvolution;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.Evolved;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.config.OperatorSet;
import io.natator.config.OptimizerKind;
import io.natator.config.Scheme;
import io.natator.config.WeightedObjective;
import io.natator.encoding.Gait;
import io.natator.process.FakeSimulator;
import io.natator.process.SceneInfo;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;

/** Servers with the real simulator, and its processes. */
final class ViewFixture {

    static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize();
    /** Without water: it starts and steps in no time. */
    static final String SCENE = "thesis/creature-1-vacuum";
    static final String GAIT = "{'frequency':1.5,'amplitude':[0.9,0.6],'phase':[0,0.6]}";
    /** Gaits that the page is given to offer. */
    static final Map<String, Gait> KNOWN = Map.of("thesis/creature-3",
            new Gait(1.2, List.of(0.1, 0.2, 0.3, 0.4, 0.5), List.of(0.0, 0.1, 0.2, 0.3, 0.4)));
    static final int PATIENCE_SECONDS = 600;

    private ViewFixture() {
    }

    /** A server on a free port of this machine alone, which begins with a creature in vacuum. */
    static ViewServer server(Path... runs) throws InterruptedException {
        return server(SCENE, runs);
    }

    /** A server that begins with a scene of creature 1. */
    static ViewServer server(String scene, Path... runs) throws InterruptedException {
        assertThat(SIMULATOR).as("built by: cmake --preset release && cmake --build --preset release").isExecutable();
        return new ViewServer(new ViewSettings(SIMULATOR, ViewSettings.LOOPBACK, 0,
                new InitialScene(scene, null, new Gait(1.5, List.of(0.9, 0.6), List.of(0.0, 0.6))), KNOWN::get,
                List.of(runs), null));
    }

    /** Evolves creature 1 for three generations of eight, with another scheme than the scene's and no real simulator. */
    static Path evolve(Path folder) throws InterruptedException {
        return evolve(FakeSimulator.in(folder), folder.resolve("my-run"),
                EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
                        .withSize(8, 3).withSeed(5).withOptimizer(OptimizerKind.RANDOM, OperatorSet.CORRECTED, 0.05),
                null);
    }

    /** Two runs of more than one gait in {@link #SCENE}, likewise: the best of each kind, and by two objectives. */
    static Path[] evolveMany(Path folder) throws IOException, InterruptedException {
        Path simulator = FakeSimulator.in(folder);
        Files.createFile(folder.resolve("tired"));
        EvolutionSettings settings = EvolutionSettings.of(SCENE, EncodingKind.DENSE, 2).withSize(20, 3).withSeed(5);
        return new Path[] {
                evolve(simulator, folder.resolve("kinds"), settings.withObjectives(OptimizerKind.MAP_ELITES, null),
                        null),
                evolve(simulator, folder.resolve("front"), settings.withObjectives(OptimizerKind.NSGA2,
                        WeightedObjective.parse("distance,work")), null)};
    }

    /** A run of bodies in vacuum, likewise. */
    static Path evolveBodies(Path folder) throws IOException, InterruptedException {
        Path simulator = FakeSimulator.in(Files.createDirectory(folder.resolve("bodies")));
        JsonNode vacuum = Json.parse("{\"fluid\":null,\"planes\":[],\"solver\":{\"gravity\":[0,0,0]}}", JsonNode.class);
        EvolutionSettings settings = EvolutionSettings.of("pool/eel", EncodingKind.SPARSE, 8).withSize(6, 5)
                .withEvolve(new BodyEvolution(Evolved.BODY, SceneInfo.bodyToEvolve("pool/eel", null, SIMULATOR),
                        EncodingKind.SPARSE.forActuators(8).decode(List.of(1.5, 0.7, 0.7, 0.9))));
        return evolve(simulator, folder.resolve("bodies-run"), settings, vacuum);
    }

    private static Path evolve(Path simulator, Path run, EvolutionSettings settings, JsonNode overrides)
            throws InterruptedException {
        new Natator(ExecutionSettings.of(simulator).withWorkers(2))
                .evolve(settings.withScene(Scheme.CONSERVING, 2.0, overrides), run);
        return run;
    }

    /** Simulators among the descendants of a process. */
    static List<ProcessHandle> simulators(ProcessHandle of) {
        return of.descendants().filter(child -> child.info().command().orElse("").endsWith("natator-sim")).toList();
    }

    /** The only simulator of this process. */
    static ProcessHandle simulator() {
        List<ProcessHandle> all = simulators(ProcessHandle.current());
        assertThat(all).hasSize(1);
        return all.get(0);
    }
}
