package io.natator.study;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

/** The overrides and gaits of the committed list of variants are what the columns of the measured runs say. */
class VariantsMatchMeasurementsTest {

    private static final Path ROOT = Path.of("..", "..");
    private static final Path VARIANTS = ROOT.resolve("results/flex-comparison/variants.json");
    private static final double LARGEST_FLOAT = Float.MAX_VALUE;

    /** Where in a scene the settings columns are. */
    private static final Map<String, String> POINTERS = Map.ofEntries(
            Map.entry("springs_per_pair", "/creature/springsPerParticle"), Map.entry("spacing", "/creature/spacing"),
            Map.entry("y0", "/creature/rearCentre/1"), Map.entry("z0", "/creature/rearCentre/2"),
            Map.entry("cluster_stiffness", "/creature/clusterStiffness"), Map.entry("substeps", "/solver/substeps"),
            Map.entry("iterations", "/solver/numIterations"), Map.entry("max_acceleration", "/solver/maxAcceleration"),
            Map.entry("relaxation_mode", "/solver/relaxationMode"), Map.entry("damping", "/solver/damping"),
            Map.entry("relaxation_factor", "/solver/relaxationFactor"), Map.entry("viscosity", "/solver/viscosity"),
            Map.entry("dynamic_friction", "/solver/dynamicFriction"), Map.entry("radius", "/solver/radius"),
            Map.entry("particle_friction", "/solver/particleFriction"),
            Map.entry("solid_pressure", "/solver/solidPressure"),
            Map.entry("max_neighbours", "/solver/maxNeighborsPerParticle"));

    /** What no variant may differ in, since a scene cannot say it. */
    private static final Map<String, String> FIXED = Map.ofEntries(
            Map.entry("middle_springs", "False"), Map.entry("joints", "standard"), Map.entry("z_sign", "1"),
            Map.entry("moving", "True"), Map.entry("solid_flags", "none"), Map.entry("solid_group", "1"),
            Map.entry("solid_inverse_mass", "1.0"), Map.entry("cavity_distance", "0.15"),
            Map.entry("zero_normals_given", "False"), Map.entry("rigids_resent_every_frame", "False"),
            Map.entry("time_shift", "0.0"), Map.entry("shape_margin", "0"), Map.entry("particle_margin", "0"),
            Map.entry("amplitude_factor", "1.0"));

    static Stream<Variant> variants() {
        return VariantFile.read(VARIANTS).stream();
    }

    @Test
    void thereAreAtLeastTwentyFour() {
        assertThat(variants()).hasSizeGreaterThanOrEqualTo(24);
    }

    @ParameterizedTest
    @MethodSource("variants")
    void settingsAgree(Variant variant) {
        for (FlexRun run : variant.flexRuns()) {
            assertThat(run.columns()).containsAllEntriesOf(FIXED);
            ObjectNode scene = patchedScene(variant.overrides());
            POINTERS.forEach((column, pointer) -> assertThat(text(scene.at(pointer)))
                    .as("%s of %s", column, run.name()).isEqualTo(normal(run.columns().get(column))));
            assertThat(variant.scene()).isEqualTo("thesis/creature-" + run.columns().get("body"));
            assertThat(scene.get("planes")).hasSize(run.columns().get("walls").equals("tank") ? 5 : 0);
            assertThat(scene.at("/solver/gravity/1").asDouble()).isEqualTo(run.inFluid() ? -10 : 0);
            assertThat(masses(scene.get("fluid"))).isEqualTo(run.columns().get("fluid_masses"));
            assertThat(scene.at("/stopping/planeContact").asBoolean()).isFalse();
            assertThat(scene.at("/stopping/noProgressAfter").asDouble()).isZero();
        }
    }

    @ParameterizedTest
    @MethodSource("variants")
    void gaitsAgree(Variant variant) {
        Gait gait = variant.gait();
        for (FlexRun run : variant.flexRuns()) {
            Map<String, String> columns = run.columns();
            assertThat(normal("" + (gait.power() == null ? 1 : gait.power()))).isEqualTo(normal(columns.get("power")));
            if (columns.get("phases").equals("thesis")) {
                boolean reversed = columns.get("actuator_order").equals("rear first");
                assertThat(gait).isEqualTo(thesisGait(columns.get("body"), reversed));
            } else {
                assertThat(columns.get("actuator_order")).isEqualTo("front first");
                assertThat(gait.frequency()).isEqualTo(Double.parseDouble(columns.get("frequency")));
                assertClose(gait.amplitude(), columns.get("amplitudes"));
                assertClose(gait.phase(), columns.get("phases"));
            }
        }
    }

    /** Table 3.1 of the thesis; body 2 with φ_i = frac(0.431 i), i from 1, as the rest lengths in one_frame show. */
    private static Gait thesisGait(String body, boolean reversed) {
        if (body.equals("1")) {
            return reversed ? new Gait(1.861, List.of(0.69, 0.973), List.of(0.648, 0.0))
                    : new Gait(1.861, List.of(0.973, 0.69), List.of(0.0, 0.648));
        }
        return new Gait(1.338, List.of(0.504, 0.4582857143, 0.4125714286, 0.3668571429, 0.3211428571, 0.2754285714,
                0.2297142857, 0.184), List.of(0.431, 0.862, 0.293, 0.724, 0.155, 0.586, 0.017, 0.448));
    }

    private static void assertClose(List<Double> ours, String theirs) {
        List<Double> values = Arrays.stream(theirs.split(" ")).map(Double::parseDouble).toList();
        assertThat(ours).hasSameSizeAs(values);
        for (int i = 0; i < ours.size(); i++) {
            assertThat(ours.get(i)).isCloseTo(values.get(i), within(5e-5));
        }
    }

    /** The thesis' tank with the creature settings that the measurements state, after the merge patch. */
    private static ObjectNode patchedScene(ObjectNode overrides) {
        ObjectNode scene = Json.read(ROOT.resolve("sim-native/scenes/thesis/tank.json"), ObjectNode.class, "scene");
        scene.set("creature", StudyFixtures.object("{\"rearCentre\": [0.45, 0.6, 0.6], \"springsPerParticle\": 4, "
                + "\"clusterStiffness\": 0.2, \"spacing\": 0.075}"));
        patch(scene, overrides);
        return scene;
    }

    /** JSON Merge Patch, RFC 7386. */
    private static void patch(ObjectNode target, ObjectNode patch) {
        patch.properties().forEach(field -> {
            if (field.getValue().isNull()) {
                target.remove(field.getKey());
            } else if (field.getValue() instanceof ObjectNode nested && target.get(field.getKey()) instanceof ObjectNode old) {
                patch(old, nested);
            } else {
                target.set(field.getKey(), field.getValue());
            }
        });
    }

    private static String masses(JsonNode fluid) {
        if (fluid == null) {
            return "";
        }
        double bottom = fluid.at("/mass/bottom").asDouble();
        double top = fluid.at("/mass/top").asDouble();
        Map<String, String> names = new HashMap<>();
        names.put("mass-linear", "mass linear " + normal("" + bottom) + " to 1/" + Math.round(1 / top));
        names.put("inverse-mass-linear", "inverse mass linear " + 1 / bottom + " to " + Math.round(1 / top));
        names.put("uniform", "uniform mass " + normal("" + bottom));
        return names.get(fluid.at("/mass/gradient").asText());
    }

    private static String text(JsonNode value) {
        return normal(value.asText());
    }

    /** Equal numbers as equal texts; {@code none} is no limit. */
    private static String normal(String value) {
        if (value.equals("none")) {
            return normal("" + LARGEST_FLOAT);
        }
        try {
            double number = Double.parseDouble(value);
            return number == Math.rint(number) && Math.abs(number) < 1e9 ? "" + Math.round(number) : "" + number;
        } catch (NumberFormatException e) {
            return value;
        }
    }
}
