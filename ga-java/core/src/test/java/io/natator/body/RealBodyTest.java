package io.natator.body;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.base.InvalidInputException;
import io.natator.cache.CachedEvaluator;
import io.natator.cache.EvaluationCache;
import io.natator.config.BodyEvolution;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.Evolved;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.process.Evaluator;
import io.natator.process.SceneInfo;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.SplittableRandom;
import java.util.stream.LongStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Bodies as the real simulator makes them. */
class RealBodyTest {

    private static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize();

    @TempDir
    private Path folder;

    @ParameterizedTest
    @ValueSource(strings = {"eel", "tadpole", "tuna"})
    void hasAsManyParticlesAndActuatorsAsThisSideThinks(String name) throws InterruptedException {
        String scene = "open-water/" + name;
        ProfileBody own = SceneInfo.bodyToEvolve(scene, null, SIMULATOR);
        BodyGenome genome = new BodyGenome(own);
        int actuators = SceneInfo.of(scene, null, SIMULATOR).actuators();
        SplittableRandom random = new SplittableRandom(1);

        assertThat(own).isEqualTo(Bodies.bundled(name));
        int taken = 0;
        for (int i = 0; i < 24; i++) {
            ProfileBody body = genome.decode(Bodies.random(genome.genes(), random));
            try {
                SceneInfo info = SceneInfo.of(scene, body.patch(), SIMULATOR);
                assertThat(info.bodyParticles()).as(body.patch().toString()).isEqualTo(body.particles());
                assertThat(info.actuators()).isEqualTo(actuators);
                assertThat(info.bodyLength()).isCloseTo(body.bodyLength(), within(1e-12));
                taken++;
            } catch (InvalidInputException e) {
                assertThat(e).hasMessageContaining("no muscle fits between these slices");
            }
        }
        assertThat(taken).isGreaterThan(18);
    }

    /** A batch may hold several bodies; neither they nor the states that are kept of them are mistaken for each other. */
    @Test
    void bodiesOfABatchSwimAsTheyDoAlone() throws InterruptedException {
        ProfileBody own = SceneInfo.bodyToEvolve("pool/eel", null, SIMULATOR);
        EvolutionSettings settings = EvolutionSettings.of("pool/eel", EncodingKind.SPARSE, 8).withScene(null, 0.1, null)
                .withEvolve(new BodyEvolution(Evolved.BOTH, own, null));
        SplittableRandom random = new SplittableRandom(5);
        List<SimulationRequest> requests = LongStream.range(0, 3).mapToObj(id -> SimulationRequest.of(id, settings,
                settings.problem().genome().decode(Bodies.random(settings.problem().genome().genes(), random))))
                .toList();
        ExecutionSettings execution = ExecutionSettings.of(SIMULATOR).withMode(SimulatorMode.PROCESS).withWorkers(2)
                .withTimeout(Duration.ofMinutes(5));

        List<String> alone = hashes(requests, execution);

        assertThat(alone).doesNotHaveDuplicates().doesNotContainNull();
        assertThat(hashes(requests, execution.withMode(SimulatorMode.BATCH))).isEqualTo(alone);
        try (CachedEvaluator cached = new CachedEvaluator(Evaluator.open(execution), new EvaluationCache(folder),
                execution)) {
            for (int found : List.of(0, 3)) {
                assertThat(cached.evaluate(requests)).extracting(SimulationResult::hash).isEqualTo(alone);
                assertThat(cached.found()).isEqualTo(found);
            }
        }
    }

    private static List<String> hashes(List<SimulationRequest> requests, ExecutionSettings execution)
            throws InterruptedException {
        try (Evaluator evaluator = Evaluator.open(execution)) {
            return evaluator.evaluate(requests).stream().map(SimulationResult::hash).toList();
        }
    }
}
