package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

/** {@code natator converge} with a simulator that computes nothing. */
class ConvergeCommandTest extends FakeSimulatorTest {

    private static final String TEXT = "not known whether converged: 0.160 ± 0.024 body lengths/s at time step and spacing 0, from -10.0 ± 2.0 % at half the spacing";
    private Path run;

    @BeforeEach
    void evolved() {
        ok(evolve("run"));
        run = folder.resolve("run");
    }

    @Test
    void tellsAndKeepsWhatTheSpeedGoesTo() throws IOException {
        ok(natator("converge", run.toString())).isEqualTo("level      substeps\n" + TEXT + "\n");
        assertThat(err.toString()).isEqualTo("base: run 1 of 2, distance 0.5\n");
        assertThat(file("run", "converge.json")).contains("\"gait\"", "\"discretisation\" : 0.02");

        ok(natator("show", run.toString())).contains("  finer steps " + TEXT + "\n");
    }

    @Test
    void unstableLevelsAreTold() throws IOException {
        Files.createFile(folder.resolve("unstable"));

        ok(natator("converge", run.toString()))
                .endsWith("not known whether converged: no speed at half the spacing (2 runs unstable)\n");
    }

    @Test
    void whatTheSimulatorRefusesIsToldInOneLine() throws IOException {
        Files.createFile(folder.resolve("refused"));

        refused(natator("converge", run.toString())).contains("gait.frequency is 70; expected a number up to 60")
                .hasLineCount(1);
        assertThat(run.resolve("converge.json")).doesNotExist();
    }

    @Test
    void oneStartIsTooFew() {
        refused(natator("converge", "--starts", "1", run.toString()))
                .contains("--starts is 1; expected a whole number from 2 to 1000").hasLineCount(1);
    }

    @Test
    void levelsAreThoseThatThereAre() {
        refused(natator("converge", "--levels", "time/3", run.toString()))
                .contains("time/3 is no level; expected one of time/2, time/4, spacing/2, both/2").hasLineCount(1);
    }

    /** A winner that has changed since has none. */
    @Test
    void whatIsOfAnotherGaitIsNotShown() throws IOException {
        ok(natator("converge", run.toString()));
        String found = file("run", "converge.json");
        Files.writeString(run.resolve("converge.json"),
                found.replaceFirst("\"frequency\" : [0-9.]+", "\"frequency\" : 0.123"));

        ok(natator("show", run.toString())).doesNotContain("converged", "finer steps");
    }
}
