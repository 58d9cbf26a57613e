package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** {@code natator evolve --islands}. */
class IslandsCommandTest extends FakeSimulatorTest {

    @Test
    void islandsGiveOneWinnerWhateverTheMode() throws IOException {
        String[] islands = {"--islands", "3", "--migrate-every", "1", "--migrants", "2"};
        for (String mode : List.of("process", "resident", "batch")) {
            out.getBuffer().setLength(0);
            assertThat(evolve(mode, islands(islands, "--simulator", mode))).as(err.toString()).isZero();
        }

        for (int i = 1; i <= 3; i++) {
            for (String name : List.of("config.json", "generations.csv", "best.json", "checkpoint.json", "evaluations.jsonl",
                    "migrants.jsonl")) {
                String file = "island-" + i + "/" + name;
                assertThat(file("resident", file)).as(file).isEqualTo(file("process", file));
                assertThat(file("batch", file)).as(file).isEqualTo(file("process", file));
            }
        }
        assertThat(out.toString()).startsWith("pool/creature-1, ").contains(
                "  islands     3 islands, seeds 5 to 7; after every generation the best 2 gaits of each go to the next\n",
                "  evaluations 3 times about 50\n", "best gait of pool/creature-1 after 3 generations")
                .containsPattern("  island  seed    generation  evaluations  best      came from others\n  1       5       3  .*\n.*\n"
                        + "  3       7       3  .*\n")
                .containsPattern("\n  \\d .* 4   winner\n").containsPattern("  run folder  .*/batch, the winner's .*/batch/island-\\d\n");
        String told = out.toString();
        out.getBuffer().setLength(0);
        assertThat(natator("show", folder.resolve("batch").toString())).isZero();
        assertThat(out.toString()).contains(told.substring(told.indexOf("  island  seed"), told.indexOf("best gait of")))
                .contains(", island ", " of 3, ", "finished\n", "best gait of pool/creature-1");
        assertThat(natator("compare", "--starts", "0", folder.resolve("batch").toString(), folder.resolve("process").toString()))
                .as(err.toString()).isZero();
        assertThat(natator("check", "--starts", "2", folder.resolve("batch").toString())).as(err.toString()).isZero();
        assertThat(natator("resume", folder.resolve("batch").toString())).as(err.toString()).isZero();
    }

    private static String[] islands(String[] options, String... more) {
        List<String> all = new ArrayList<>(List.of(options));
        all.addAll(List.of(more));
        return all.toArray(String[]::new);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
        "--islands 0 | --islands is 0; expected a whole number from 1 to 1024",
        "--islands 2000 | --islands is 2000; expected a whole number from 1 to 1024",
        "--migrants 2 | --migrants is for several islands; expected --islands with it, from 2",
        "--islands 1 --migrate-every 2 | --migrate-every is for several islands; expected --islands with it, from 2",
        "--islands 3 --migrate-every 0 | --migrate-every is 0; expected a whole number from 1",
        "--islands 3 --migrate-every 3 | generations between exchanges are 3; expected fewer than the run's 3, or no migrants",
        "--islands 3 --migrants 8 | migrants are 8; expected fewer than the population, 8",
        "--islands 3 --migrants -1 | --migrants is -1; expected a whole number from 0",
        "--islands 3 --optimizer cma-es | optimizer cma-es takes no migrants; expected jgap, or islands without migrants",
        "--islands 3 --optimizer random | optimizer random takes no migrants; expected jgap, or islands without migrants"})
    void islandsThatCannotBeAreRefusedInOneLine(String options, String message) {
        assertThat(evolve("run", options.split(" "))).isEqualTo(2);

        assertThat(err.toString()).isEqualTo("natator evolve: " + message + "\n");
        assertThat(folder.resolve("run")).doesNotExist();
    }

    @Test
    void islandsWithoutMigrantsTakeAnyOptimizer() throws IOException {
        assertThat(evolve("run", "--islands", "2", "--migrants", "0", "--optimizer", "cma-es")).as(err.toString()).isZero();
        assertThat(evolve("plain", "--optimizer", "cma-es")).isZero();

        assertThat(file("run", "island-1/evaluations.jsonl")).isEqualTo(file("plain", "evaluations.jsonl"));
        assertThat(file("run", "island-1/best.json")).isEqualTo(file("plain", "best.json"));
    }

    /** A kill may come between its last generation and the drawing. */
    @Test
    void aFinishedIslandWithoutItsCurveGetsIt() throws IOException {
        assertThat(evolve("run", "--islands", "2")).as(err.toString()).isZero();
        Path curve = folder.resolve("run/island-2/plots/fitness.png");
        Files.delete(curve);

        assertThat(natator("resume", folder.resolve("run").toString())).as(err.toString()).isZero();

        assertThat(curve).isNotEmptyFile();
    }

    @Test
    void anIslandIsNotResumedAlone() {
        assertThat(evolve("run", "--islands", "2")).as(err.toString()).isZero();
        err.getBuffer().setLength(0);

        assertThat(natator("resume", folder.resolve("run/island-2").toString())).isEqualTo(2);

        assertThat(err.toString()).isEqualTo("natator resume: " + folder.resolve("run/island-2")
                + " is one of 2 islands, which go on together; expected the folder that they are in\n");
    }
}
