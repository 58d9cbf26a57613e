package io.natator.study;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class VariantFileTest {

    private static final String FILE = """
            {"about": "test", "measurements": "runs.csv",
             "commonOverrides": {"stopping": {"planeContact": false}, "solver": {"damping": 1, "gravity": [0, 0, 0]}},
             "gaits": {"g": {"frequency": 1, "amplitude": [0.5], "phase": [0]}},
             "variants": [{"name": "one", "about": "first", "flexRuns": "rep_[0-4]", "scene": "s", "gait": "g",
                           "overrides": {"fluid": null, "solver": {"damping": 2}}}]}
            """;

    @TempDir
    private Path directory;

    @BeforeEach
    void writeMeasurements() throws IOException {
        Files.writeString(directory.resolve("runs.csv"), """
                name,medium,note,v_0_2,v_0_4
                rep_0,fluid,,0.5,1
                rep_1,fluid,,0.7,2
                rep_9,fluid,,9,9
                xrep_1,vacuum,,8,8
                """);
    }

    @Test
    void wholeNamesMatchTheExpression() throws IOException {
        Variant variant = read(FILE).get(0);
        assertThat(variant.flexRuns()).extracting(FlexRun::name).containsExactly("rep_0", "rep_1");
        assertThat(variant.flexRuns()).extracting(run -> run.speed(Interval.TWO_SECONDS)).containsExactly(0.5, 0.7);
        assertThat(variant.inFluid()).isTrue();
    }

    @Test
    void patchesComposeWithNullsKept() throws IOException {
        assertThat(read(FILE).get(0).overrides()).isEqualTo(StudyFixtures.object("""
                {"stopping": {"planeContact": false}, "solver": {"damping": 2, "gravity": [0, 0, 0]}, "fluid": null}
                """));
    }

    @Test
    void unknownGaitIsNamed() {
        assertThatThrownBy(() -> read(FILE.replace("\"gait\": \"g\"", "\"gait\": \"h\"")))
                .isInstanceOf(InvalidInputException.class).hasMessageContaining("variant one: gait is h");
    }

    @Test
    void runsThatNobodyMeasuredAreNamed() {
        assertThatThrownBy(() -> read(FILE.replace("rep_[0-4]", "absent")))
                .isInstanceOf(InvalidInputException.class).hasMessageContaining("flexRuns is absent");
    }

    @Test
    void aRaggedTableIsRefused() throws IOException {
        Files.writeString(directory.resolve("runs.csv"), "name,medium,v_0_2,v_0_4\nrep_0,fluid,1\n");
        assertThatThrownBy(() -> read(FILE)).isInstanceOf(InvalidInputException.class).hasMessageContaining("line 2");
    }

    private List<Variant> read(String content) throws IOException {
        return VariantFile.read(Files.writeString(directory.resolve("variants.json"), content));
    }
}
