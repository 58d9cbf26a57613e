package io.natator.body;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.InvalidInputException;
import io.natator.config.Json;
import io.natator.encoding.DenseEncoding;
import io.natator.encoding.Gait;
import io.natator.encoding.GeneRange;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import org.junit.jupiter.api.RepeatedTest;
import org.junit.jupiter.api.RepetitionInfo;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

class BodyGenomeTest {

    private static final List<String> NAMES = List.of("eel", "tadpole", "tuna");

    /** What {@code natator-sim info} says of the bundled bodies, see creatures.md. */
    @ParameterizedTest
    @CsvSource({"eel, 142", "tadpole, 187", "tuna, 286"})
    void countsTheParticlesOfTheBundledBodies(String name, int particles) {
        assertThat(Bodies.bundled(name).particles()).isEqualTo(particles);
    }

    @ParameterizedTest
    @ValueSource(strings = {"eel", "tadpole", "tuna"})
    void theScenesOwnGenesGiveItsOwnBody(String name) {
        ProfileBody scene = Bodies.bundled(name);
        BodyGenome genome = new BodyGenome(scene);

        ProfileBody same = genome.decode(genome.own());

        assertThat(same.length()).isEqualTo(scene.length());
        assertThat(same.height()).isEqualTo(scene.height());
        assertThat(same.width()).isEqualTo(scene.width());
        assertThat(same.fin()).isEqualTo(scene.fin());
        assertThat(same.stiffness()).isEqualTo(scene.stiffness());
        assertThat(same.jointSlices()).isEqualTo(scene.jointSlices());
        for (double place = 0; place <= 1; place += 0.01) {
            assertThat(same.muscles().at(place)).isCloseTo(scene.muscles().at(place), within(1e-12));
        }
    }

    @Test
    void genesAreNamedByWhatTheyChange() {
        List<String> names = new BodyGenome(Bodies.bundled("tuna")).genes().stream().map(GeneRange::name).toList();

        assertThat(names).containsExactly("length", "height at 0 %", "height at 38 %", "height at 86 %", "width at 0 %",
                "width at 38 %", "width at 86 %", "fin height", "joint 1", "joint 2", "joint 3", "joint 4", "joint 5",
                "stiffness at 0 %", "stiffness at 50 %", "stiffness at 100 %", "muscle strength at 0 %",
                "muscle strength at 70 %", "muscle strength at 100 %");
    }

    @RepeatedTest(300)
    void everyGenomeGivesABodyOfTheSameVolumeAndStrength(RepetitionInfo seed) {
        SplittableRandom random = new SplittableRandom(seed.getCurrentRepetition());
        ProfileBody scene = Bodies.bundled(NAMES.get(random.nextInt(3)));
        BodyGenome genome = new BodyGenome(scene);

        ProfileBody body = genome.decode(Bodies.random(genome.genes(), random));

        assertThat((double) body.particles() / scene.particles()).isCloseTo(1, within(0.02));
        assertThat(body.strength()).isCloseTo(scene.strength(), within(1e-6));
        assertThat(body.muscles().points()).allSatisfy(point -> assertThat(point.value()).isBetween(0.0, 1.0));
        List<Integer> joints = body.jointSlices();
        assertThat(joints).hasSameSizeAs(scene.joints()).isSorted().doesNotHaveDuplicates();
        assertThat(joints.get(0)).isPositive();
        assertThat(body.part(joints.get(joints.size() - 1))).isLessThan(body.finBegin());
        assertThat(body.height().points())
                .allSatisfy(point -> assertThat(point.value() / 0.075).isGreaterThanOrEqualTo(1.5));
        assertThat(body.width().points())
                .allSatisfy(point -> assertThat(point.value() / 0.075).isGreaterThanOrEqualTo(1.5));
        assertThat(scene.with(body.patch())).isEqualTo(body);
    }

    @Test
    void curvesWithFewPointsGetMore() {
        ObjectNode creature = Bodies.creature("eel").deepCopy();
        ((ObjectNode) creature.get("profile")).put("height", 0.25);

        BodyGenome genome = new BodyGenome(ProfileBody.of(creature));

        assertThat(genome.genes()).extracting(GeneRange::name).contains("height at 0 %", "height at 25 %",
                "height at 50 %",
                "height at 75 %", "height at 100 %", "muscle strength at 50 %");
        assertThat(genome.decode(genome.own()).particles()).isEqualTo(ProfileBody.of(creature).particles());
    }

    /** Muscles fit into a fin of two particles, so joints may be there. */
    @Test
    void jointsInAThickFinStayThere() {
        ObjectNode creature = Bodies.creature("tuna").deepCopy();
        ObjectNode profile = (ObjectNode) creature.get("profile");
        ((ObjectNode) profile.get("fin")).put("thickness", 0.15);
        profile.putArray("joints").add(0.5).add(0.7).add(0.8).add(0.92);
        ProfileBody scene = ProfileBody.of(creature);

        BodyGenome genome = new BodyGenome(scene);

        assertThat(genome.genes()).allSatisfy(gene -> assertThat(gene.lower()).isLessThan(gene.upper()));
        assertThat(genome.decode(genome.own()).jointSlices()).isEqualTo(scene.jointSlices()).contains(18);
    }

    @Test
    void aGenomeOfBothHasTheGaitsGenesFirst() {
        ProfileBody eel = Bodies.bundled("eel");
        DenseEncoding gaits = new DenseEncoding(8);
        BodyGenome bodies = new BodyGenome(eel);
        Genome both = Genome.ofBoth(gaits, eel);
        List<Double> genes = new ArrayList<>(gaits.genes().stream().map(GeneRange::upper).toList());
        genes.addAll(bodies.own());

        Swimmer swimmer = both.decode(genes);

        assertThat(both.genes()).hasSize(genes.size());
        assertThat(swimmer.gait()).isEqualTo(gaits.decode(genes.subList(0, 16)));
        assertThat(swimmer.body()).isEqualTo(bodies.decode(bodies.own()).patch());
        assertThatThrownBy(() -> both.decode(genes.subList(1, genes.size())))
                .hasMessageStartingWith("39 genes given; expected 40");
    }

    @Test
    void bodiesAloneSwimWithTheGivenGait() {
        Gait gait = new Gait(1.5, List.of(1.0, 1.0), List.of(0.0, 0.5));
        Genome genome = Genome.ofBody(gait, Bodies.bundled("eel"));

        assertThat(genome.middle().gait()).isEqualTo(gait);
        assertThat(genome.genes()).hasSameSizeAs(new BodyGenome(Bodies.bundled("eel")).genes());
    }

    @Test
    void aBodyIsTheSameAfterAFile() throws Exception {
        ProfileBody tuna = Bodies.bundled("tuna");

        assertThat(Json.parse(Json.line(tuna), ProfileBody.class)).isEqualTo(tuna);
    }

    @Test
    void otherBodiesAreRefused() {
        JsonNode slices = Bodies.creature("creature-1");
        ObjectNode muscles = Bodies.creature("eel").deepCopy();
        muscles.putArray("muscleSlices").add(2).add(4);

        assertThatThrownBy(() -> ProfileBody.of(slices)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("not given by a profile").hasMessageContaining("open-water/eel");
        assertThatThrownBy(() -> ProfileBody.of(muscles)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("creature.muscleSlices");
    }
}
