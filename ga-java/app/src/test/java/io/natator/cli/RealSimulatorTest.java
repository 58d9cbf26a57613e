package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assumptions.assumeThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.EvaluationStatistics;
import io.natator.checkpoint.RunReader;
import io.natator.config.Json;
import io.natator.config.Preset;
import io.natator.process.ProgramInfo;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** The whole way from the command line through the real simulator and back. */
class RealSimulatorTest extends CommandTest {

    /** A tenth of the pool's particles. */
    private static final String SMALL = "bench/small-tank";

    @Test
    void aTinyEvolution() throws IOException {
        Path run = folder.resolve("run");

        ok(natator("evolve", "--scene", SMALL, "--scheme", "conserving", "--population", "6", "--generations", "2",
                "--duration", "0.1", "--output-dir", run.toString()));

        List<String> rows = Files.readAllLines(run.resolve("generations.csv"));
        assertThat(rows).hasSize(4);
        JsonNode best = Json.parse(Files.readString(run.resolve("best.json")), JsonNode.class);
        assertThat(best.get("result").get("simulated").asDouble()).isBetween(0.09, 0.11);
        assertThat(best.get("result").get("hash").asText()).matches("[0-9a-f]{16}");
        assertThat(best.get("vacuum").get("status").asText()).isEqualTo("ok");
        assertThat(Files.readString(run.resolve("evaluations.jsonl")).lines().filter(line -> line.contains("\"ok\"")))
                .as("evaluations that went well").hasSizeGreaterThan(6);

        ok(natator("evaluate", "--scene", SMALL, "--scheme", "conserving", "--duration", "0.1", "--gait",
                run.resolve("best.json").toString()));
        JsonNode again = Json.parse(out.toString(), JsonNode.class);
        assertThat(again.get("hash")).isEqualTo(best.get("result").get("hash"));
        assertThat(again.get("distance")).isEqualTo(best.get("distance"));
    }

    /** Muscles around control points, of meshes that are no fish; results/pictures has what long evolutions make of them. */
    @ParameterizedTest
    @CsvSource({"jellyfish, 2", "torus, 4", "turtle, 6"})
    void aMeshLearnsToSwim(String body, int actuators) throws IOException {
        Path run = folder.resolve(body);
        Path still = folder.resolve("still.json");
        String zeros = Collections.nCopies(actuators, 0).toString();
        Files.writeString(still, "{\"frequency\": 1, \"amplitude\": " + zeros + ", \"phase\": " + zeros + "}");

        ok(natator("evolve", "--scene", "pool/" + body, "--optimizer", "cma-es", "--population", "6", "--generations",
                "2",
                "--duration", "1", "--seed", "1", "--output-dir", run.toString()));
        JsonNode best = Json.parse(Files.readString(run.resolve("best.json")), JsonNode.class);
        ok(natator("evaluate", "--scene", "pool/" + body, "--duration", "1", "--gait", still.toString()));
        double drift = Json.parse(out.toString(), JsonNode.class).get("distance").asDouble();

        assertThat(best.get("result").get("status").asText()).isEqualTo("ok");
        assertThat(best.get("distance").asDouble()).as("ahead of a body whose muscles rest")
                .isGreaterThan(drift + 0.005);
        assertThat(best.get("vacuum").get("distance").asDouble()).as("without water").isBetween(-1e-3, 1e-3);
    }

    @Test
    void commandsSwimAsTheProgramDoesOrAreRefused() throws InterruptedException {
        String swim = "evaluate --scene pool/creature-1 --duration 0.1 --gait 1.5 0.6 0.69 0.5";
        String[] elsewhere = words(swim, "--simulator-command", "exec " + SIMULATOR + " serve");
        ok(natator(swim));
        String here = out.toString();

        ok(natator(elsewhere)).isEqualTo(here);

        assumeThat(ProgramInfo.of(SIMULATOR).instructionSet()).isNotEqualTo("portable");
        elsewhere[elsewhere.length - 1] = "NATATOR_ISA=portable exec " + SIMULATOR + " serve";
        refused(natator(elsewhere)).contains("swims otherwise than this program", "NATATOR_ISA").containsOnlyOnce("\n");
    }

    /** By the names that are typed, of the scenes that the command has. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "evolve --dry-run --creature fry|pool/fry|1, 2, 3, 4, eel, jellyfish, loach, ray, tadpole, torus, tuna, turtle",
            "evolve --dry-run --preset thesis --creature loach|open-water/loach|1, 2, 3, 4, eel, ray, tadpole, tuna",
            "view --no-browser --port 0 --creature loach|open-water/loach|1, 2, 3, 4, eel, ray, tadpole, tuna"})
    void aCreatureThatIsNotThereIsToldWithThoseThatAre(String command, String scene, String creatures) {
        refused(natator(command)).isEqualTo("natator " + words(command)[0] + ": --creature "
                + command.replaceFirst(".* ", "") + ": no scene " + scene + "; expected one of " + creatures + "\n");
    }

    @Test
    void helpAndDocumentHaveAllCreatures() throws IOException, InterruptedException {
        ok(execute("evolve", "--help"));
        String help = out.toString().replaceAll("\\s+", " ");
        String document = Files.readString(Path.of("../docs/evolving.md")).lines()
                .filter(line -> line.startsWith("- `--creature`: 1 to 4, ")).findFirst().orElseThrow();
        List<String> always = SceneChoice.creatures(Preset.THESIS, SIMULATOR);
        List<String> quick = new ArrayList<>(SceneChoice.creatures(Preset.QUICK, SIMULATOR));
        quick.removeAll(always);
        List<String> names = always.subList(4, always.size());

        assertThat(help).contains(
                ": " + String.join(", ", names) + "; with the preset quick also " + String.join(", ", quick) + ".");
        assertThat(document).isEqualTo("- `--creature`: 1 to 4, `" + String.join("`, `", names)
                + "`; with `--preset quick` also `" + String.join("`, `", quick) + "`");
    }

    /** In the pool, whose scheme has no clamp; half a second is too short to swim, so only what was run is looked at. */
    @ParameterizedTest
    @CsvSource({"pool/creature-1, false", "thesis/creature-1, true"})
    void aWinnerIsCheckedByItsControls(String scene, boolean hasClamp) throws IOException {
        Path run = folder.resolve("run");
        ok(natator("evolve", "--scene", scene, "--population", "3", "--generations", "0", "--duration", "0.2",
                "--output-dir", run.toString()));

        ok(natator("check", "--starts", "2", run.toString())).contains("in water ", "with resting muscles ",
                "in vacuum ", "half the time step ",
                "mirrored ", "other backend             not tried", "under water ", "2 completed",
                "half the spacing          not tried: natator converge " + run, "\nverdict: ");
        assertThat(out.toString().contains("no acceleration clamp")).isEqualTo(hasClamp);
        Controls controls = Json.read(run.resolve("check.json"), Controls.class, "check");
        assertThat(controls.underWater()).isBetween(0.5, 1.0);
        assertThat(controls.water().distance().sd()).as("two different starts").isPositive();
        assertThat(controls.halfStep().substeps()).isEqualTo(2 * controls.water().substeps());
        assertThat(Math.abs(controls.vacuum().distance().mean())).isLessThan(hasClamp ? 1 : 1e-6);
        assertThat(controls.resting().work() == null ? 0 : controls.resting().work()).isZero();
        assertThat(controls.mirrored().distance()).isNotEqualTo(controls.water().distance());

        ok(execute("show", run.toString())).contains("  checked     ");
    }

    /** A duration that frames do not fill ends with the last of them. */
    @Test
    void aSwimIsCheckedAtItsEndWhereverThatIs() throws IOException {
        Path run = folder.resolve("run");
        ok(natator("evolve --scene pool/eel --population 3 --generations 0 --duration 0.105", "--output-dir",
                run.toString()));
        ok(natator("check", "--starts", "2", run.toString()));
        assertThat(err.toString()).doesNotContain("no snapshot", "--at");
        assertThat(run.resolve("check.json")).content().contains("underWater");
    }

    /** A body that evolved, too, and what is run already is not run again. */
    @Test
    void aWinnersSpeedIsFollowedToFinerSteps() throws IOException {
        Path run = folder.resolve("run");
        ok(natator("evolve --scene pool/eel --evolve both --population 3 --generations 0 --duration 0.1",
                "--output-dir", run.toString()));

        ok(natator("converge", "--starts", "2", "--levels", "time/2", run.toString())).contains("level ", "\nbase ",
                "\ntime/2 ", " at time step and spacing 0, from ");
        assertThat(err.toString().lines()).as("runs").hasSize(4)
                .allMatch(line -> line.matches("(base|time/2): run [12] of 2, .*"));
        assertThat(run.resolve("converge.jsonl")).content().hasLineCount(4).contains("\"profile\"");

        String found = out.toString();
        ok(natator("converge", "--starts", "2", "--levels", "time/2", run.toString())).isEqualTo(found);
        assertThat(run.resolve("converge.jsonl")).content().hasLineCount(4);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "--duration 0.1 --optimizer nsga2 --objectives forward,work|front|of several objectives, the gaits that no other is better than",
            "--duration 0.5 --optimizer map-elites --objectives forward=1,straight=0.1|elites|map of gaits: "})
    void whatIsMoreThanOneGaitIsShown(String options, String key, String line) throws IOException {
        Path run = folder.resolve("run");
        ok(natator("evolve --population 4 --generations 1 " + options, "--output-dir", run.toString()));

        ok(natator("show", run.toString(), "--generation", "0"));
        assertThat(GaitFile.read(Files.writeString(folder.resolve("first.json"), out.toString())).body()).isNull();
        ok(execute("show", run.toString())).contains(line);
        ok(execute("show", "--json", run.toString()));
        assertThat(Json.parse(out.toString(), JsonNode.class).get(key)).isNotEmpty();
    }

    /** In scheme flex muscles have no work that could be measured. */
    @ParameterizedTest
    @CsvSource({"--objectives, work, objective work: this simulator does not measure it in scheme flex",
            "--optimizer, map-elites, optimizer map-elites: this simulator does not measure the muscles' work in scheme flex"})
    void whatIsNotMeasuredIsNoObjective(String option, String value, String message) {
        refused(natator("evolve --preset thesis --population 2 --generations 0 --starts 1 --duration 0.02", option,
                value, "--output-dir", path("run")));

        assertThat(err.toString().lines().reduce((first, second) -> second).orElseThrow())
                .startsWith("natator evolve: " + message);
        assertThat(out.toString()).as("not said in the plan as well").contains("  time        not known\n")
                .doesNotContain("does not measure");
    }

    /** Each mode on the same backend; a generation's evaluations also arrive at a batch in another order. */
    @ParameterizedTest
    @ValueSource(strings = {"1", "2"})
    void everyModeGivesTheSameBits(String starts) throws IOException {
        List<String> logs = new ArrayList<>();
        for (String mode : List.of("process", "resident", "batch")) {
            Path run = folder.resolve(mode);
            ok(natator("evolve", "--scene", SMALL, "--scheme", "conserving", "--population", "4", "--generations", "1",
                    "--duration", "0.05", "--workers", "2", "--starts", starts, "--no-cache", "--simulator", mode,
                    "--output-dir", run.toString()));
            logs.add(Files.readString(run.resolve("evaluations.jsonl")) + Files.readString(run.resolve("best.json")));
        }

        assertThat(logs.get(0)).contains("\"hash\":");
        assertThat(logs.get(1)).isEqualTo(logs.get(0));
        assertThat(logs.get(2)).isEqualTo(logs.get(0));
    }

    /** The definition of the scene, as the real simulator gives it, is a part of the key. */
    @Test
    void aSecondRunTakesItsResultsFromTheCache() throws IOException {
        for (String name : List.of("first", "second", "without")) {
            String more = name.equals("without") ? " --no-cache" : "";
            ok(natator("evolve --scheme conserving --population 4 --generations 1 --duration 0.05" + more,
                    "--scene", SMALL, "--output-dir", path(name)));
        }

        assertSameRuns("second", "without");
        EvaluationStatistics statistics = RunReader.statistics(folder.resolve("second"));
        assertThat(statistics.fromCache()).isEqualTo(statistics.evaluations()).isPositive();
        assertThat(RunReader.statistics(folder.resolve("without")).fromCache()).isZero();
    }

    /** With one joint there is no muscle between two. */
    @ParameterizedTest
    @ValueSource(strings = {"evolve --creature 1", "evolve --creature 2"})
    void aCreatureThatCannotMoveIsNotEvolved(String command) {
        Path output = folder.resolve("output");
        String[] arguments = words(command, "--overrides", "{\"creature\":{\"joints\":[5]}}", "--output-dir",
                output.toString());
        refused(natator(arguments));

        assertThat(err.toString().lines()).singleElement().asString().startsWith("natator " + arguments[0])
                .contains("cannot move by itself: it has no actuators").contains("at least two joints");
        assertThat(output).doesNotExist();
    }
}
