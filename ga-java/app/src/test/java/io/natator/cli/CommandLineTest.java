package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import io.natator.simulator.FakeSimulator;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;

class CommandLineTest {

    @TempDir
    private Path folder;
    private Path simulator;
    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    @BeforeEach
    void fake() {
        simulator = FakeSimulator.in(folder);
    }

    private int natator(String... arguments) {
        CommandLine command = Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true));
        List<String> all = new ArrayList<>(List.of(arguments));
        all.addAll(1, List.of("--simulator-path", simulator.toString()));
        if (arguments[0].equals("show")) {
            return command.execute(arguments);
        }
        if (!arguments[0].equals("evaluate")) {
            // The fake's faults are not what the cache is to keep.
            all.add(1, "--no-cache");
        }
        return command.execute(all.toArray(String[]::new));
    }

    private int evolve(String runName, String... more) {
        List<String> arguments = new ArrayList<>(List.of("evolve", "--population", "8", "--generations", "3", "--seed",
                "5", "--output-dir", folder.resolve(runName).toString()));
        arguments.addAll(List.of(more));
        return natator(arguments.toArray(String[]::new));
    }

    private String file(String runName, String name) throws IOException {
        return Files.readString(folder.resolve(runName).resolve(name));
    }

    @Test
    void evolvesAndReports() throws IOException {
        assertThat(evolve("run")).as(err.toString()).isZero();

        assertThat(out.toString()).startsWith("pool/creature-1, jgap (corrected operators), population 8, 3 generations")
                .contains("  evaluations about 50\n", "  time        at most ",
                        "best gait of pool/creature-1 after 3 generations",
                        "  distance    -0.04", " in 2.00 s; 4 fresh starts, all completed\n", "  half step   ", "  selected    ",
                        " by one run, ", "  verdict     does not swim: moves -0.04 ± 0.0",
                        "  try more --generations", "natator view --run " + folder.resolve("run"),
                        "natator page " + folder.resolve("run"),
                        "frequency", "amplitude", "phase", "distance", "speed",
                        "  cost        work of the muscles 0.75 mass · length²/s²\n",
                        "  flow        Reynolds number 131, Strouhal number 0.313\n", "in vacuum",
                        "run folder  " + folder.resolve("run"));
        assertThat(err.toString().lines()).hasSize(4).allSatisfy(line -> assertThat(line)
                .matches("generation \\d of 3, mean -?\\d\\.\\d{4}, best -?\\d\\.\\d{4}, evaluations \\d+ of (about )?\\d+, "
                        + "elapsed \\d+s, left .*"));
        JsonNode best = Json.parse(file("run", "best.json"), JsonNode.class);
        assertThat(best.get("vacuum").get("status").asText()).isEqualTo("ok");
        JsonNode environment = Json.parse(file("run", "environment.json"), JsonNode.class);
        assertThat(environment.get("simulatorSha256").asText()).matches("[0-9a-f]{64}");
        assertThat(environment.get("version").asText()).isEqualTo("0.1.0");
        assertThat(environment.get("commit").asText()).isEqualTo("0123456789ab");
        assertThat(environment.get("instructionSet").asText()).isEqualTo("any");
        assertThat(best.get("bodyLength").asDouble()).isEqualTo(1.2);
        assertThat(folder.resolve("run/plots/fitness.png")).isNotEmptyFile();
    }

    @ParameterizedTest
    @CsvSource({"corrected", "stock"})
    void theWorkersDoNotChangeAByte(String operators) throws IOException {
        assertThat(evolve("one", "--workers", "1", "--operators", operators)).isZero();
        assertThat(evolve("four", "--workers", "4", "--operators", operators)).isZero();

        for (String name : List.of("config.json", "generations.csv", "best.json", "checkpoint.json",
                "evaluations.jsonl")) {
            assertThat(file("four", name)).as(name).isEqualTo(file("one", name));
        }
    }

    @ParameterizedTest
    @CsvSource({"jgap, 1", "cma-es, 1", "random, 1", "jgap, 3", "cma-es, 3"})
    void theModeDoesNotChangeAByte(String optimizer, int starts) throws IOException {
        for (String mode : List.of("process", "resident", "batch")) {
            assertThat(evolve(mode, "--simulator", mode, "--workers", "3", "--optimizer", optimizer, "--evaluations",
                    "29", "--starts", "" + starts)).as(err.toString()).isZero();
        }

        for (String name : List.of("config.json", "generations.csv", "best.json", "checkpoint.json",
                "evaluations.jsonl")) {
            assertThat(file("resident", name)).as(name).isEqualTo(file("process", name));
            assertThat(file("batch", name)).as(name).isEqualTo(file("process", name));
        }
        assertThat(file("process", "evaluations.jsonl").lines()).hasSize(29);
    }

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

    @Test
    void anIslandIsNotResumedAlone() {
        assertThat(evolve("run", "--islands", "2")).as(err.toString()).isZero();
        err.getBuffer().setLength(0);

        assertThat(natator("resume", folder.resolve("run/island-2").toString())).isEqualTo(2);

        assertThat(err.toString()).isEqualTo("natator resume: " + folder.resolve("run/island-2")
                + " is one of 2 islands, which go on together; expected the folder that they are in\n");
    }

    @Test
    void stopsInTimeAndContinues() throws IOException {
        Files.writeString(folder.resolve("slow"), "0.4");
        assertThat(evolve("run", "--workers", "1", "--stop-after", "5")).isZero();
        assertThat(err.toString()).endsWith("time is up; continue by: natator resume " + folder.resolve("run") + "\n");
        assertThat(file("run", "evaluations.jsonl").lines()).hasSizeBetween(1, 20);
        Files.delete(folder.resolve("slow"));

        assertThat(natator("resume", folder.resolve("run").toString(), "--simulator", "resident")).isZero();
        assertThat(evolve("whole")).isZero();

        for (String name : List.of("generations.csv", "best.json", "checkpoint.json", "evaluations.jsonl")) {
            assertThat(file("run", name)).as(name).isEqualTo(file("whole", name));
        }
    }

    /** The fake has no GPU, but auto is another backend than cpu all the same. */
    @Test
    void aRunCanMoveToAnotherBackendAndSaysSo() throws IOException {
        Files.writeString(folder.resolve("slow"), "0.5");
        assertThat(evolve("run", "--stop-after", "0.3")).isZero();
        Files.delete(folder.resolve("slow"));
        err.getBuffer().setLength(0);

        assertThat(natator("resume", folder.resolve("run").toString(), "--backend", "auto")).isZero();

        assertThat(err.toString()).startsWith("backend was cpu, is now auto: last digits");
        assertThat(Json.parse(file("run", "config.json"), JsonNode.class).get("backend").asText()).isEqualTo("auto");
        assertThat(Json.parse(file("run", "environment.json"), JsonNode.class).get("backend").asText())
                .isEqualTo("auto");
        err.getBuffer().setLength(0);
        assertThat(natator("resume", folder.resolve("run").toString())).isZero();
        assertThat(err.toString()).doesNotContain("backend was");
    }

    @Test
    void comparesOptimizersInPieces() throws IOException {
        String[] study = {"compare-optimizers", "--output-dir", folder.resolve("study").toString(), "--creatures", "1",
            "--seeds", "2", "--evaluations", "30", "--population", "6", "--simulator", "batch"};
        List<String> piece = new ArrayList<>(List.of(study));
        piece.addAll(List.of("--stop-after", "0.3"));
        Files.writeString(folder.resolve("slow"), "0.5");
        assertThat(natator(piece.toArray(String[]::new))).as(err.toString()).isZero();
        assertThat(out.toString()).contains("of 8 runs finished; the same command continues");

        Files.delete(folder.resolve("slow"));
        assertThat(natator(study)).as(err.toString()).isZero();
        assertThat(file("study", "README.md")).contains("8 of 8 runs are finished", "| jgap-corrected | 6 | 2 |",
                "| jgap-stock | 6 | 2 |", "| cma-es | 8 | 2 |", "| random | 6 | 2 |");
        assertThat(folder.resolve("study/creature-1.png")).isNotEmptyFile();
        assertThat(folder.resolve("study/creature-1/random/seed-2/plots/fitness.png")).isNotEmptyFile();

        String page = file("study", "README.md");
        assertThat(page).contains("At equal evaluations:", "At equal simulated time:", "too few to tell");
        List<String> compact = new ArrayList<>(List.of(study));
        compact.add("--compact");
        assertThat(natator(compact.toArray(String[]::new))).as(err.toString()).isZero();
        assertThat(file("study", "README.md")).isEqualTo(page);
        assertThat(file("study", "creature-1.jsonl")).hasLineCount(8);
        assertThat(folder.resolve("study/creature-1")).doesNotExist();
    }

    @Test
    void showsARunAtAnyTime() throws IOException {
        assertThat(evolve("run", "--scene", "fault/mixed", "--vacuum-check")).as(err.toString()).isZero();
        out.getBuffer().setLength(0);

        assertThat(natator("show", folder.resolve("run").toString())).as(err.toString()).isZero();
        assertThat(out.toString()).startsWith("fault/mixed, jgap (corrected operators), population 8, 3 generations, ")
                .contains("generation 3: best ", "; finished", "best gait of fault/mixed after 3 generations",
                        "early stop  0.0 %", "unchanged ", "cache       0 evaluations", "in vacuum",
                        "evaluations failed, the last, ", "no valid result")
                .containsPattern("  failed      [1-9][0-9]* of [0-9]+ evaluations gave no answer, so the same seed");

        Files.delete(folder.resolve("run/checkpoint.json"));
        Files.delete(folder.resolve("run/best.json"));
        out.getBuffer().setLength(0);
        assertThat(natator("show", folder.resolve("run").toString())).as(err.toString()).isZero();
        assertThat(out.toString()).contains("generation 0 under way: ");
    }

    @Test
    void comparesRunsAtTheSameNumberOfEvaluations() throws IOException {
        assertThat(evolve("short", "--optimizer", "cma-es", "--evaluations", "24")).isZero();
        assertThat(evolve("long", "--optimizer", "random", "--evaluations", "32")).isZero();
        out.getBuffer().setLength(0);

        assertThat(natator("compare", folder.resolve("short").toString(), folder.resolve("long").toString())).isZero();
        List<String> lines = out.toString().lines().toList();
        assertThat(lines.get(0)).contains("cma-es");
        assertThat(lines.get(2)).isEqualTo("evaluations      best 1      best 2");
        assertThat(lines.get(3)).matches(" {10}4 +\\d\\.\\d{4} +\\d\\.\\d{4}");
        assertThat(lines.get(8)).matches(" {9}32 {12} +\\d\\.\\d{4}");
        JsonNode best = Json.parse(file("long", "best.json"), JsonNode.class);
        assertThat(lines.get(8)).endsWith(String.format(" %.4f", Math.max(best.get("distance").asDouble(), 0)));
        assertThat(lines.get(9)).startsWith("1  does not swim: moves ");
        assertThat(lines.get(10)).contains("distance ", " ± ", "4 fresh starts", "body lengths/s", "in vacuum", "phi ");
        assertThat(lines.get(11)).startsWith("   half step ");
        assertThat(lines.get(12)).contains("   selected ", " by one run, ", " again");
        assertThat(lines.get(17)).isEqualTo("at equal evaluations (24), from 8 fresh starts: median distance [95 % bootstrap interval]");
        assertThat(lines.get(18)).matches(" {3}run 1 {2}-?\\d\\.\\d{4} \\[-?\\d\\.\\d{4}, -?\\d\\.\\d{4}]");
        assertThat(lines.get(20)).matches(" {3}run 1 less run 2 {2}-?\\d.*]: (run [12] further than run [12]|no difference seen) "
                + "\\(p [=<] 0\\.\\d+, A = \\d\\.\\d\\d\\)");
        assertThat(lines.get(21)).startsWith("at equal simulated time (");
        assertThat(lines).hasSize(25);
        assertThat(err.toString()).contains(" swims from fresh starts; --starts 0 leaves that out");
        out.getBuffer().setLength(0);

        assertThat(natator("compare", "--starts", "0", folder.resolve("short").toString(), folder.resolve("long").toString()))
                .isZero();
        assertThat(out.toString().lines()).containsExactlyElementsOf(lines.subList(0, 17));
    }

    /** Two seeds of each: the runs are the sample. */
    @Test
    void comparesGroupsOfRunsThatDifferOnlyInTheirSeeds() {
        List<String> arguments = new ArrayList<>(List.of("compare", "--starts", "2"));
        for (String seed : List.of("1", "2")) {
            for (String optimizer : List.of("cma-es", "random")) {
                String run = folder.resolve(optimizer + seed).toString();
                assertThat(natator("evolve", "--population", "8", "--optimizer", optimizer, "--evaluations", "16", "--seed", seed,
                        "--output-dir", run)).as(err.toString()).isZero();
                arguments.add(run);
            }
        }
        out.getBuffer().setLength(0);

        assertThat(natator(arguments.toArray(String[]::new))).as(err.toString()).isZero();
        assertThat(out.toString()).contains("at equal evaluations (16), from 2 fresh starts: median distance of the runs' means [",
                "\n   runs 1+3  ", "\n   runs 2+4  ", "\n   runs 1+3 less runs 2+4  ", "]: too few to tell\n");
    }

    @ParameterizedTest
    @CsvSource({"show", "compare"})
    void whatIsNoRunIsNamed(String command) {
        String nothing = folder.resolve("nothing").toString();

        assertThat(command.equals("show") ? natator(command, nothing) : natator(command, nothing, nothing))
                .isEqualTo(2);
        assertThat(err.toString().strip())
                .isEqualTo("natator " + command + ": " + nothing + " is not a run folder: it has no config.json");
    }

    @Test
    void aDryRunPlansAndDoesNothing() {
        assertThat(evolve("run", "--dry-run", "--workers", "3")).as(err.toString()).isZero();

        assertThat(out.toString()).contains("evaluations about 50", "process, 3 at once", "time limit 1m16s each",
                "run folder  " + folder.resolve("run"), "time        at most ");
        assertThat(folder.resolve("run")).doesNotExist();
    }

    @Test
    void withoutOptionsItIsTheQuickPreset() {
        assertThat(natator("evolve", "--dry-run", "--output-dir", folder.resolve("run").toString())).isZero();
        assertThat(out.toString()).startsWith("pool/creature-1, jgap (corrected operators), population 16, 3 generations,")
                .contains(", backend cpu, 2.0 s\n", "evaluations about 100\n");
        out.getBuffer().setLength(0);

        assertThat(natator("evolve", "--dry-run", "--preset", "quick", "--scheme", "flex", "--duration", "3")).isZero();
        assertThat(out.toString()).contains(", scheme flex, 3.0 s\n");
        out.getBuffer().setLength(0);

        assertThat(natator("evolve", "--dry-run", "--preset", "thesis")).isZero();
        assertThat(out.toString()).startsWith("thesis/creature-1, ").contains("population 150, 100 generations", ", backend cpu\n");
    }

    @Test
    void aPlanThatCannotBeTimedDoesNotKeepTheRunFromBeginning() {
        assertThat(evolve("run", "--scene", "fault/mixed")).as(err.toString()).isZero();

        assertThat(out.toString()).contains("time        not known: a trial evaluation failed: ", "best gait of fault/mixed");
    }

    @Test
    void aStoredGaitThatComesOutOtherwiseIsNamed() throws IOException {
        assertThat(evolve("run")).isZero();
        Path best = folder.resolve("run/best.json");
        String[] again = {"evaluate", "--scene", "pool/creature-1", "--duration", "2", "--gait", best.toString()};
        err.getBuffer().setLength(0);
        assertThat(natator(again)).isZero();
        assertThat(err.toString()).isEmpty();

        JsonNode stored = Json.parse(file("run", "best.json"), JsonNode.class);
        String distance = stored.get("distance").asText();
        Files.writeString(best, Files.readString(best).replace(distance, "0.1234")
                .replace(stored.get("result").get("hash").asText(), "00000000deadbeef"));
        assertThat(natator(again)).isZero();
        assertThat(err.toString()).isEqualTo(String.format("%s: stored 0.1234, today's program %.4f (the same program: no "
                + "reason is known)%n", folder.resolve("run"), stored.get("distance").asDouble()));

        err.getBuffer().setLength(0);
        again[4] = "3";
        assertThat(natator(again)).isZero();
        assertThat(err.toString()).as("another simulation").isEmpty();
    }

    @Test
    void aMissingGpuIsOneLine() {
        assertThat(evolve("run", "--backend", "cuda")).isEqualTo(1);
        assertThat(err.toString().strip()).isEqualTo("natator evolve: simulator: no such device here");
    }

    /** Many more at once than there are processors would only wait for each other. */
    @Test
    void aDryRunTriesNoMoreThanTheProcessorsDoAtOnce() {
        assertThat(evolve("run", "--dry-run", "--workers", "1024")).as(err.toString()).isZero();

        assertThat(out.toString()).contains("process, 1024 at once",
                Runtime.getRuntime().availableProcessors() + " evaluations take ");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
        "compare-optimizers --output-dir NEVER --rank-starts 0|--rank-starts is 0; expected a whole number from 1 to 1000",
        "compare NEVER NEVER --starts 1|--starts is 1; expected 0, or a whole number from 2 to 1000",
        "compare-optimizers --output-dir NEVER --seeds 100000|--seeds is 100000; expected a whole number from 1 to 10000",
        "compare-optimizers --output-dir NEVER --runs-at-once 5000|--runs-at-once is 5000; expected a whole number from 1 to 1024",
        "compare-optimizers --output-dir NEVER --cma-es-population 1000000|population is 1000000; expected a whole number"})
    void absurdNumbersOfOtherCommandsAreRefused(String arguments, String message) {
        assertThat(natator(arguments.replace("NEVER", folder.resolve("never").toString()).split(" "))).isEqualTo(2);
        assertThat(err.toString().lines()).hasSize(1);
        assertThat(err.toString()).contains(message);
        assertThat(folder.resolve("never")).doesNotExist();
    }

    @Test
    void whatFollowsFromTheCheckpointMayBeDamaged() throws IOException {
        assertThat(evolve("run")).isZero();
        String best = file("run", "best.json");
        out.getBuffer().setLength(0);
        Files.writeString(folder.resolve("run/best.json"), best.substring(0, best.length() / 2));
        Files.writeString(folder.resolve("run/savings.json"), "{");

        assertThat(natator("show", folder.resolve("run").toString())).as(err.toString()).isZero();
        assertThat(out.toString()).contains("best gait of pool/creature-1 after 3 generations",
                "  flow        Reynolds number 131, Strouhal number 0.313\n");

        assertThat(natator("resume", folder.resolve("run").toString())).as(err.toString()).isZero();
        assertThat(file("run", "best.json")).isEqualTo(best);
    }

    @Test
    void aDamagedCountOfSavingsDoesNotStopARun() throws IOException {
        assertThat(evolve("whole")).isZero();
        assertThat(evolve("run")).isZero();
        String before = file("run", "checkpoint.json");
        Files.writeString(folder.resolve("run/savings.json"), "[1");
        Files.delete(folder.resolve("run/checkpoint.json"));

        assertThat(natator("resume", folder.resolve("run").toString())).as(err.toString()).isZero();

        assertThat(file("run", "checkpoint.json")).isEqualTo(before);
        assertThat(file("run", "savings.json")).isEqualTo(file("whole", "savings.json"));
    }

    @Test
    void resumingTellsHowFarTheWholeRunIs() throws IOException {
        assertThat(evolve("run")).isZero();
        List<String> all = file("run", "evaluations.jsonl").lines().toList();
        Files.delete(folder.resolve("run/checkpoint.json"));
        Files.write(folder.resolve("run/evaluations.jsonl"), all.subList(0, all.size() - 3));
        err.getBuffer().setLength(0);

        assertThat(natator("resume", folder.resolve("run").toString())).as(err.toString()).isZero();
        assertThat(err.toString().lines().reduce((first, last) -> last).orElseThrow()).startsWith("generation 3 of 3, mean ")
                .contains(", evaluations " + all.size() + " of " + all.size() + ", ");
    }

    @Test
    void anOutputFolderThatCannotBeIsSaidInWords() throws IOException {
        Files.writeString(folder.resolve("file"), "");
        assertThat(evolve("file/run")).isEqualTo(2);
        assertThat(err.toString().strip()).startsWith("natator evolve: output folder " + folder.resolve("file/run")
                + " cannot be made: ").doesNotContain("java.", "Exception");
    }

    @Test
    void creature2IsSparseUnlessToldOtherwise() throws IOException {
        assertThat(evolve("sparse", "--creature", "2")).isZero();
        assertThat(evolve("dense", "--creature", "2", "--encoding", "dense")).isZero();

        assertThat(Json.parse(file("sparse", "best.json"), JsonNode.class).get("genes")).hasSize(4);
        assertThat(Json.parse(file("dense", "best.json"), JsonNode.class).get("genes")).hasSize(16);
        assertThat(Json.parse(file("sparse", "best.json"), JsonNode.class).get("gait").get("phase")).hasSize(8);
    }

    @Test
    void faultsCostOnlyTheirOwnEvaluation() throws IOException {
        assertThat(evolve("faults", "--scene", "fault/mixed")).as(err.toString()).isZero();

        assertThat(file("faults", "evaluations.jsonl").lines().filter(line -> line.contains("\"failed\"")))
                .isNotEmpty().allSatisfy(line -> assertThat(line).contains("\"error\":\"no valid result"));
        assertThat(file("faults", "generations.csv").lines()).hasSize(5);
    }

    @Test
    void aRunInWhichAllFailsEndsWithOneLine() {
        assertThat(evolve("broken", "--scene", "fault/exit")).isEqualTo(1);

        assertThat(err.toString().lines()).hasSize(1);
        assertThat(err.toString()).startsWith("natator evolve: generation 0: 8 of 8 simulations failed, the first: ")
                .contains("out of luck");
    }

    @Test
    void refusesAFolderThatIsNotEmpty() {
        assertThat(evolve("run")).isZero();
        err.getBuffer().setLength(0);

        assertThat(evolve("run")).isEqualTo(2);
        assertThat(err.toString().lines()).hasSize(1);
        assertThat(err.toString()).contains("is not empty");
    }

    @Test
    void resumingAFinishedRunChangesNothing() throws IOException {
        assertThat(evolve("run")).isZero();
        String before = file("run", "generations.csv") + file("run", "best.json") + file("run", "evaluations.jsonl");

        assertThat(natator("evolve", "--resume", folder.resolve("run").toString(), "--workers", "3")).isZero();
        assertThat(file("run", "generations.csv") + file("run", "best.json") + file("run", "evaluations.jsonl"))
                .isEqualTo(before);
    }

    @Test
    void resumingKeepsTheSettings() {
        assertThat(evolve("run")).isZero();
        err.getBuffer().setLength(0);

        assertThat(natator("evolve", "--resume", folder.resolve("run").toString(), "--seed", "6")).isEqualTo(2);
        assertThat(err.toString()).startsWith("natator evolve: --seed cannot be given with --resume");
    }

    @Test
    void checkNeedsTwoStartsAndARun() throws IOException {
        assertThat(evolve("run")).isZero();
        out.getBuffer().setLength(0);
        for (String starts : List.of("1", "0", "2000")) {
            err.getBuffer().setLength(0);
            assertThat(natator("check", "--starts", starts, folder.resolve("run").toString())).isEqualTo(2);
            assertThat(err.toString()).isEqualTo("natator check: --starts is " + starts
                    + "; expected a whole number from 2 to 1000\n");
        }
        assertThat(natator("check", folder.toString())).isEqualTo(2);
        assertThat(folder.resolve("run/check.json")).doesNotExist();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
        "--population 1|population is 1",
        "--generations -1|generations is -1",
        "--generations many|'many' is not an int",
        "--creature 5|--creature is 5; expected 1, 2, 3 or 4, or the name of a bundled body",
        "--creature ../eel|--creature is ../eel; expected 1, 2, 3 or 4, or the name",
        "--creature 1 --scene thesis/creature-2|exclude each other",
        "--workers 0|workers is 0",
        "--device -1|device is -1",
        "--evaluations 0|evaluations is 0",
        "--starts 0|starts is 0; expected a whole number from 1 to 1000",
        "--starts 3 --judge lower-quartile|starts is 3; expected at least 4 with --judge lower-quartile",
        "--judge median|starts is 1; expected at least 3 with --judge median",
        "--objectives distance,work|optimizer jgap has one objective, not distance and work",
        "--optimizer nsga2|optimizer nsga2 is for several objectives",
        "--objectives speed|--objectives has 'speed'; expected some of",
        "--judge max|expected mean, median or lower-quartile but was 'max'",
        "--starts 4 --evaluations 3|evaluations is 3; expected at least the 4 starts of one gait",
        "--stop-after 0|--stop-after is 0.0",
        "--simulator thread|expected process, resident, batch or spark but was 'thread'",
        "--backend opencl|expected cpu, cuda or auto but was 'opencl'",
        "--optimizer cma|expected jgap, cma-es, random, nsga2 or map-elites but was 'cma'; did you mean cma-es?",
        "--fitness speed|expected distance or net",
        "--timeout 0|--timeout is 0.0",
        "--timeout NaN|--timeout is NaN",
        "--timeout 1e300|--timeout is 1.0E300; expected a number of seconds above 0, up to 100000000",
        "--stop-after 1e300|--stop-after is 1.0E300; expected a number of seconds above 0, up to 100000000",
        "--workers 5000|workers is 5000; expected a whole number from 1 to 1024",
        "--population 2000000000|population is 2000000000; expected a whole number from 2 to 100000",
        "--duration -1|duration is -1.0",
        "--gaussian-deviation 0|gaussian-deviation is 0.0",
        "--operators magic|expected corrected or stock",
        "--encoding magic|expected dense, sparse, dense-steered or sparse-steered",
        "--preset quik|expected quick or thesis but was 'quik'; did you mean quick?",
        "--scene no/such|expected a named scene or a file",
        "--scene no/such.json|expected a named scene or an existing file",
        "--overrides no-such.json|no-such.json does not exist",
        "--overrides {\"solver\":|--overrides: ",
        "--seed|Missing required parameter for option '--seed'",
        "--sed 3|--sed is no option of this command; did you mean --seed? See natator evolve --help",
        "--resume no/such/folder|no/such/folder is not a run folder"})
    void badUsageIsOneLineAndStatus2(String arguments, String message) {
        List<String> all = new ArrayList<>(List.of("evolve"));
        all.addAll(List.of(arguments.split(" ")));
        if (!arguments.startsWith("--resume")) {
            all.addAll(1, List.of("--output-dir", folder.resolve("never").toString()));
        }

        assertThat(natator(all.toArray(String[]::new))).isEqualTo(2);
        assertThat(err.toString().lines()).hasSize(1);
        assertThat(err.toString()).startsWith("natator evolve: ").contains(message);
        assertThat(out.toString()).isEmpty();
        assertThat(folder.resolve("never")).doesNotExist();
    }

    @Test
    void aMissingSimulatorIsNamed() {
        CommandLine command = Main.commandLine().setErr(new PrintWriter(err, true));

        assertThat(command.execute("evolve", "--simulator-path", "no/such/program")).isEqualTo(2);
        assertThat(err.toString().strip())
                .isEqualTo("natator evolve: --simulator-path is no/such/program; expected an executable file");
    }

    @Test
    void evaluatesGenes() throws IOException {
        assertThat(natator("evaluate", "--scene", "thesis/creature-1", "--gait", "1.5", "0.1", "0.2", "0.3")).isZero();

        assertThat(Json.parse(out.toString(), JsonNode.class).get("distance").asDouble()).isEqualTo(-1.3925);
    }

    @Test
    void evaluatesAGaitFileAndTheBestOfARun() throws IOException {
        Path gait = Files.writeString(folder.resolve("gait.json"),
                "{\"$schema\":\"gait.schema.json\",\"frequency\":1.5,\"amplitude\":[0.1,0.2],\"phase\":[0,0.3]}");
        assertThat(natator("evaluate", "--scene", "thesis/creature-1", "--gait", gait.toString())).isZero();
        assertThat(Json.parse(out.toString(), JsonNode.class).get("distance").asDouble()).isEqualTo(-1.3925);

        assertThat(evolve("run")).isZero();
        JsonNode best = Json.parse(file("run", "best.json"), JsonNode.class);
        out.getBuffer().setLength(0);
        assertThat(natator("evaluate", "--scene", "pool/creature-1", "--gait",
                folder.resolve("run/best.json").toString())).isZero();
        JsonNode again = Json.parse(out.toString(), JsonNode.class);
        assertThat(again.get("distance")).isEqualTo(best.get("distance"));
        assertThat(again.get("swimming").get("reynolds").asDouble()).isEqualTo(131.4);
        assertThat(again.get("work").asDouble()).isEqualTo(0.75);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
        "thesis/creature-1|1.5 0.1 0.2|3 genes given; expected 4",
        "thesis/creature-1|1.5 0.1 zero 0.3|gene 3 is 'zero'; expected a number",
        "thesis/creature-1|2.5 0.1 0.2 0.3|gene 1 (frequency) is 2.5; expected a number from 0.5 to 2.0",
        "thesis/creature-1|NaN 0.1 0.2 0.3|gene 1 (frequency) is NaN",
        "thesis/creature-1|no-such.json|no-such.json does not exist",
        "fault/rejected|1.5 0.1 0.2 0.3|simulator: gait.frequency is 70"})
    void badGaitsAreNamed(String scene, String gait, String message) {
        List<String> all = new ArrayList<>(List.of("evaluate", "--scene", scene, "--gait"));
        all.addAll(List.of(gait.split(" ")));

        assertThat(natator(all.toArray(String[]::new))).isEqualTo(2);
        assertThat(err.toString().lines()).hasSize(1);
        assertThat(err.toString()).startsWith("natator evaluate: ").contains(message);
    }

    @Test
    void anEvaluationThatFailsSaysWhyAndEndsWithStatus1() throws IOException {
        assertThat(natator("evaluate", "--scene", "fault/exit", "--gait", "1.5", "0.1", "0.2", "0.3")).isEqualTo(1);

        JsonNode result = Json.parse(out.toString(), JsonNode.class);
        assertThat(result.get("status").asText()).isEqualTo("failed");
        assertThat(result.get("error").asText()).contains("out of luck");
    }
}
