package io.natator.body;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.InvalidInputException;
import io.natator.simulator.SceneInfo;
import java.nio.file.Path;
import java.util.SplittableRandom;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Bodies as the real simulator makes them. */
class RealBodyTest {

    private static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize();

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
}
