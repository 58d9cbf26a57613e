package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import java.io.IOException;
import java.nio.file.Files;
import org.junit.jupiter.api.Test;

/** {@code natator evolve}: what it says and writes, the same bytes in every mode, and faults that cost no more than they must. */
class EvolveCommandTest extends FakeSimulatorTest {

    @Test
    void evolvesAndReports() throws IOException {
        ok(evolve("run"))
                .startsWith("pool/creature-1, jgap (corrected operators), population 8, 3 generations")
                .contains("  evaluations about 49\n", "  time        about ",
                        "best gait of pool/creature-1 after 3 generations",
                        "  distance    -0.04", " in 2.00 s; 4 fresh starts, all completed\n", "  half step   ",
                        "  selected    ",
                        " by one run, ", "  verdict     does not swim: moves -0.038 ± 0.0",
                        "  try more --generations", "natator view --run " + folder.resolve("run"),
                        "natator page " + folder.resolve("run"),
                        "frequency", "amplitude", "phase", "distance", "speed",
                        "  cost        work of the muscles 0.75 mass · length²/s²\n",
                        "  flow        Reynolds number 131, Strouhal number 0.313\n", "in vacuum",
                        "run folder  " + folder.resolve("run"));
        assertThat(err.toString().lines()).hasSize(4).allSatisfy(line -> assertThat(line)
                .matches(
                        "generation \\d of 3, mean -?\\d\\.\\d{4}, best -?\\d\\.\\d{4}, evaluations \\d+ of (about )?\\d+, "
                                + "elapsed \\d+s, left .*"));
        JsonNode best = Json.parse(file("run", "best.json"), JsonNode.class);
        assertThat(best.get("vacuum").get("status").asText()).isEqualTo("ok");
        JsonNode environment = Json.parse(file("run", "environment.json"), JsonNode.class);
        assertThat(environment.get("simulatorSha256").asText()).matches("[0-9a-f]{64}");
        assertThat(environment.get("version").asText()).isEqualTo("0.1.0");
        assertThat(environment.get("commit").asText()).isEqualTo("0123456789ab");
        assertThat(environment.get("instructionSet").asText()).isEqualTo("any");
        assertThat(best.get("bodyLength").asDouble()).isEqualTo(1.2);
    }

    /** What is printed to be copied is read by a shell. */
    @Test
    void aFolderWithASpaceIsQuotedInCommands() throws IOException {
        String run = "'" + folder.resolve("minnow one") + "'";
        ok(evolve("minnow one", "--optimizer", "map-elites")).contains("natator view --run " + run + "\n",
                "natator page " + run + "\n",
                "run folder  " + folder.resolve("minnow one"));
        ok(natator("show", path("minnow one"))).contains("natator view --run " + run + " swims them");

        Files.writeString(folder.resolve("slow"), "0.2");
        ok(evolve("one cut", "--workers", "1", "--stop-after", "1"));
        assertThat(err.toString())
                .endsWith("time is up; continue by: natator resume '" + folder.resolve("one cut") + "'\n");
        ok(natator("show", path("one cut")))
                .contains("continue by: natator resume '" + folder.resolve("one cut") + "'\n");
    }

    @Test
    void aDryRunPlansAndDoesNothing() {
        ok(evolve("run", "--dry-run", "--workers", "3")).contains("evaluations about 49", "process, 3 at once",
                "time limit 1m16s each",
                "run folder  " + folder.resolve("run"), "time        about ");
        assertThat(folder.resolve("run")).doesNotExist();
    }

    /** The first generation swims from as many starts as the others, and has its race. */
    @Test
    void aPlanCountsTheStartsOfTheFirstGeneration() throws IOException {
        ok(evolve("run", "--optimizer", "random", "--starts", "3"));

        long lines = file("run", "evaluations.jsonl").lines().count();
        assertThat(out.toString()).contains("\n  evaluations " + lines + "\n", " and " + lines + " evaluations\n");
    }

    @Test
    void withoutOptionsItIsTheQuickPreset() {
        ok(natator("evolve", "--dry-run", "--output-dir", path("run")))
                .startsWith("plane/loach, jgap (corrected operators), population 20, 3 generations,")
                .contains(", wave genes, objectives distance=1.0,work=5.0E-5, backend cpu\n",
                        "evaluations about 122\n");
        ok(natator("evolve", "--dry-run", "--creature", "1"))
                .startsWith("pool/creature-1, jgap (corrected operators), population 16, ")
                .contains(", dense genes, backend cpu, 2.0 s\n");
        ok(natator("evolve", "--dry-run", "--fitness", "distance")).contains(", wave genes, backend cpu\n");
        ok(natator("evolve", "--dry-run", "--optimizer", "map-elites")).contains(", wave genes, backend cpu\n");

        ok(natator("evolve", "--dry-run", "--preset", "quick", "--scheme", "flex", "--duration", "3"))
                .contains(", scheme flex, 3.0 s\n");

        ok(natator("evolve", "--dry-run", "--preset", "thesis")).startsWith("thesis/creature-1, ").contains(
                "population 150, 100 generations",
                ", backend cpu\n");
    }

    @Test
    void oneGenerationIsNotSeveral() {
        ok(evolveTo(1, "run", "--workers", "1")).contains(", 1 generation, ", " ends early: 1 takes ",
                " after 1 generation and ");
    }

    /** Many more at once than there are processors would only wait for each other. */
    @Test
    void aDryRunTriesNoMoreThanTheProcessorsDoAtOnce() {
        ok(evolve("run", "--dry-run", "--workers", "1024")).contains("process, 1024 at once",
                Runtime.getRuntime().availableProcessors() + " take ");
    }

    @Test
    void creature2IsSparseUnlessToldOtherwise() throws IOException {
        ok(evolve("sparse", "--creature", "2"));
        ok(evolve("dense", "--creature", "2", "--encoding", "dense"));

        assertThat(Json.parse(file("sparse", "best.json"), JsonNode.class).get("genes")).hasSize(4);
        assertThat(Json.parse(file("dense", "best.json"), JsonNode.class).get("genes")).hasSize(16);
        assertThat(Json.parse(file("sparse", "best.json"), JsonNode.class).get("gait").get("phase")).hasSize(8);
    }

    /** Nor does a plan that cannot be timed keep the run from beginning. */
    @Test
    void faultsCostOnlyTheirOwnEvaluation() throws IOException {
        ok(evolve("faults", "--scene", "fault/mixed")).contains("time        not known: a trial evaluation failed: ",
                "best gait of fault/mixed");

        assertThat(file("faults", "evaluations.jsonl").lines().filter(line -> line.contains("\"failed\"")))
                .isNotEmpty().allSatisfy(line -> assertThat(line).contains("\"error\":\"no valid result"));
        assertThat(file("faults", "generations.csv").lines()).hasSize(5);
    }

    @Test
    void aRunInWhichAllFailsEndsWithOneLine() {
        assertThat(evolve("broken", "--scene", "fault/exit")).isEqualTo(1);

        assertThat(err.toString()).hasLineCount(1)
                .startsWith("natator evolve: generation 0: 8 of 8 simulations failed, the first: ")
                .contains("out of luck");
    }

    /** The runs are those that each seed gives alone. */
    @Test
    void evolvesWithSeveralSeedsInPieces() throws IOException {
        String command = "evolve --creature 1 --seeds 3 --evaluations 30 --population 6 --simulator batch";
        String[] study = words(command, "--output-dir", path("study"));
        Files.writeString(folder.resolve("slow"), "0.5");
        ok(natator(command + " --stop-after 0.3", "--output-dir", path("study")))
                .contains(" of 3 runs finished in ", "; the same command continues");

        Files.delete(folder.resolve("slow"));
        ok(natator(study)).endsWith("3 of 3 runs finished in " + folder.resolve("study") + "\n");
        ok(natator("evolve --creature 1 --seed 2 --evaluations 30 --population 6 --output-dir", path("alone")));
        assertThat(folder.resolve("study/seed-2/evaluations.jsonl"))
                .hasSameBinaryContentAs(folder.resolve("alone/evaluations.jsonl"));

        study[6] = "40";
        refused(natator(study)).contains("seed-1 was begun with other settings: evaluations was 30, is now 40")
                .hasLineCount(1);
    }
}
