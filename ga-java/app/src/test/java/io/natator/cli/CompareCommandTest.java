package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import org.assertj.core.api.AbstractStringAssert;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** {@code natator compare}, {@code show} and {@code check}: what is read from runs. */
class CompareCommandTest extends FakeSimulatorTest {

    @Test
    void showsARunAtAnyTime() throws IOException {
        ok(evolve("run", "--scene", "fault/mixed", "--vacuum-check"));

        ok(natator("show", path("run")))
                .startsWith("fault/mixed, jgap (corrected operators), population 8, 3 generations, ")
                .contains("generation 3: best ", "; finished", "best gait of fault/mixed after 3 generations",
                        "early stop  0.0 %", "unchanged ", "cache       0 evaluations", "in vacuum",
                        "evaluations failed, the last, ", "no valid result")
                .containsPattern("  failed      [1-9][0-9]* of [0-9]+ evaluations gave no answer, so the same seed");

        Files.delete(folder.resolve("run/checkpoint.json"));
        Files.delete(folder.resolve("run/best.json"));
        ok(natator("show", path("run")))
                .containsPattern("no checkpoint.json, [1-9][0-9] evaluations of several generations; continue by: ");
    }

    @Test
    void comparesRunsAtTheSameNumberOfEvaluations() throws IOException {
        ok(evolve("short", "--optimizer", "cma-es", "--evaluations", "24"));
        ok(evolve("long", "--optimizer", "random", "--evaluations", "32"));

        ok(natator("compare", path("short"), path("long")));
        List<String> lines = out.toString().lines().toList();
        assertThat(lines.get(0)).contains("cma-es");
        assertThat(lines.get(2)).isEqualTo("evaluations      best 1      best 2");
        assertThat(lines.get(3)).matches(" {10}4 +-?\\d\\.\\d{4} +-?\\d\\.\\d{4}");
        assertThat(lines.get(8)).matches(" {9}32 {12} +-?\\d\\.\\d{4}");
        JsonNode best = Json.parse(file("long", "best.json"), JsonNode.class);
        assertThat(lines.get(8)).endsWith(String.format(" %.4f", best.get("distance").asDouble()));
        assertThat(lines.get(9)).startsWith("1  does not swim: moves ");
        assertThat(lines.get(10)).contains("distance ", " ± ", "4 fresh starts", "body lengths/s", "in vacuum", "phi ");
        assertThat(lines.get(11)).startsWith("   half step ");
        assertThat(lines.get(12)).contains("   selected ", " by one run, ", " again");
        assertThat(lines.get(17))
                .isEqualTo("at equal evaluations (24), from 8 fresh starts: median distance [95 % bootstrap interval]");
        assertThat(lines.get(18)).matches(" {3}run 1 {2}-?\\d\\.\\d{4} \\[-?\\d\\.\\d{4}, -?\\d\\.\\d{4}]");
        assertThat(lines.get(20))
                .matches(" {3}run 1 less run 2 {2}-?\\d.*]: (run [12] further than run [12]|no difference seen) "
                        + "\\(p [=<] 0\\.\\d+, A = \\d\\.\\d\\d\\)");
        assertThat(lines.get(21)).startsWith("at equal simulated time (");
        assertThat(lines).hasSize(25);
        assertThat(err.toString()).contains(" swims from fresh starts; --starts 0 leaves that out");

        ok(natator("compare", "--starts", "0", path("short"), path("long")));
        assertThat(out.toString().lines()).containsExactlyElementsOf(lines.subList(0, 17));
    }

    /** By what both were evolved for; where that differs, by distance. */
    @Test
    void comparesByWhatRunsWereEvolvedFor() throws IOException {
        List<String> arguments = new ArrayList<>(List.of("compare", "--starts", "2"));
        for (String optimizer : List.of("random", "cma-es")) {
            ok(evolve(optimizer, "--optimizer", optimizer, "--objectives", "work=0.5", "--evaluations", "16"));
            arguments.add(path(optimizer));
        }
        ok(natator(arguments))
                .contains("from 2 fresh starts: median worth by work=0.5 [95 % bootstrap interval]\n   run 1  -")
                .doesNotContain("median distance");

        ok(evolve("far", "--evaluations", "16"));
        arguments.add(path("far"));
        ok(natator(arguments)).contains("from 2 fresh starts: median distance [").doesNotContain("median worth");
    }

    /** A cost is an objective that is never above 0. */
    @Test
    void aSmallOrNegativeWorthIsNotNothing() throws IOException {
        for (String optimizer : List.of("random", "cma-es")) {
            ok(evolve(optimizer, "--optimizer", optimizer, "--objectives", "work=0.00001", "--evaluations", "16"));
        }
        assertThat(out.toString())
                .containsPattern("selected +-0\\.0{4,}[1-9]\\d\\d by one run, -0\\.0{4,}[1-9]\\d\\d again");
        ok(natator("show", path("random"))).containsPattern(
                "best -0\\.0{4,}[1-9]\\d\\d, mean -0\\.0{4,}[1-9]\\d\\d, median -0\\.0{4,}[1-9]\\d\\d;");
        ok(natator("compare", "--starts", "2", path("random"), path("cma-es")))
                .containsPattern("\n +16 +-0\\.0{4,}[1-9]\\d\\d").containsPattern("\n   run 1  -0\\.0{4,}[1-9]");
    }

    @Test
    void steeredGaitsAreToldWithTheirOffsets() throws IOException {
        ok(evolve("sparse", "--encoding", "sparse-steered"));
        ok(evolve("dense", "--encoding", "dense-steered"));
        double offset = Json.parse(file("dense", "best.json"), JsonNode.class).at("/gait/offset/0").doubleValue();
        String both = String.format(Locale.ROOT, "%.4f %<.4f", offset);
        assertThat(out.toString()).contains("\n  offset      " + both + "\n");

        ok(natator("compare", "--starts", "0", path("dense"), path("sparse"))).contains(", dense-steered genes, ",
                ", sparse-steered genes, ",
                ", offset " + both + "\n");
    }

    /** Two seeds of each: the runs are the sample. */
    @Test
    void comparesGroupsOfRunsThatDifferOnlyInTheirSeeds() {
        List<String> arguments = new ArrayList<>(List.of("compare", "--starts", "2"));
        for (String seed : List.of("1", "2")) {
            for (String optimizer : List.of("cma-es", "random")) {
                String run = folder.resolve(optimizer + seed).toString();
                ok(natator("evolve --population 8 --fitness distance", "--optimizer", optimizer, "--evaluations", "16",
                        "--seed", seed, "--output-dir", run));
                arguments.add(run);
            }
        }

        ok(natator(arguments)).contains(
                "at equal evaluations (16), from 2 fresh starts: median distance of the runs' means [",
                "\n   runs 1+3  ", "\n   runs 2+4  ", "\n   runs 1+3 less runs 2+4  ", "]: too few to tell\n");
    }

    /** What results/optimizers is made of. */
    @Test
    void writesWhatRunsAreComparedByAsJson() throws IOException {
        List<String> arguments = new ArrayList<>(List.of("compare", "--starts", "4", "--rank-starts", "3", "--json",
                path("runs.jsonl")));
        for (String optimizer : List.of("cma-es", "random")) {
            String run = path(optimizer);
            ok(natator("evolve --population 8", "--optimizer", optimizer, "--evaluations", "40", "--output-dir", run));
            arguments.add(run);
        }

        ok(natator(arguments));
        List<String> lines = Files.readString(folder.resolve("runs.jsonl")).lines().toList();
        assertThat(lines).hasSize(2);
        for (String line : lines) {
            JsonNode run = Json.parse(line, JsonNode.class);
            JsonNode best = Json.parse(Files.readString(Path.of(run.get("run").textValue()).resolve("best.json")),
                    JsonNode.class);
            assertThat(run.get("best").get("genes")).isEqualTo(best.get("genes"));
            assertThat(run.get("improvements").size()).isPositive();
            assertThat(run.at("/improvements/0/evaluation").isInt()).isTrue();
            // The winner's fresh runs are those that its run has of it.
            assertThat(run.get("again")).isNotEmpty().anySatisfy(one -> {
                assertThat(one.get("genes")).isEqualTo(best.get("genes"));
                assertThat(one.get("runs")).hasSize(4);
                double sum = 0;
                for (JsonNode worth : one.get("runs")) {
                    sum += worth.doubleValue();
                }
                assertThat(sum / 4).isCloseTo(best.at("/fresh/again").doubleValue(), within(1e-12));
            });
            assertThat(run.get("last")).isNotEmpty().allSatisfy(one -> assertThat(one.get("runs")).hasSize(3));
        }
    }

    /** Before anything swims; what is there stays as it is. */
    @Test
    void aFileOfJsonIsReplacedOnlyIfWanted() throws IOException, InterruptedException {
        ok(evolve("one"));
        ok(evolve("two", "--optimizer", "random"));
        Path file = Files.writeString(folder.resolve("runs.jsonl"), "mine");
        Path link = Files.createSymbolicLink(folder.resolve("link"), file);
        Path pipe = folder.resolve("pipe");
        assertThat(new ProcessBuilder("mkfifo", pipe.toString()).start().waitFor()).isZero();
        String what = ", which is a device or a pipe; expected the name of a file, new or to be replaced\n";

        refusesJson(pipe, "--force").isEqualTo("natator compare: output file is " + pipe + what);
        refusesJson(folder.resolve("no/runs.jsonl")).contains("; expected a folder that exists, unlike ");
        for (Path there : List.of(file, link)) {
            refusesJson(there).isEqualTo("natator compare: output file " + there
                    + " is already there; choose another by --json, or replace it by --force\n");
        }
        assertThat(file).hasContent("mine");

        ok(natator("compare", "--starts", "2", "--json", link.toString(), "--force", path("one"), path("two")));
        assertThat(link).isSymbolicLink();
        assertThat(Files.readAllLines(file)).hasSize(2);
    }

    private AbstractStringAssert<?> refusesJson(Path file, String... more) {
        List<String> arguments = new ArrayList<>(
                List.of("compare", "--starts", "2", "--json", file.toString(), path("one"), path("two")));
        arguments.addAll(List.of(more));
        AbstractStringAssert<?> said = refused(natator(arguments)).hasLineCount(1);
        assertThat(out.toString()).isEmpty();
        return said;
    }

    @ParameterizedTest
    @CsvSource({"show", "compare"})
    void whatIsNoRunIsNamed(String command) {
        String nothing = path("nothing");

        refused(command.equals("show") ? natator(command, nothing) : natator(command, nothing, nothing))
                .isEqualTo("natator " + command + ": " + nothing + " is not a run folder: it has no config.json\n");
    }

    @Test
    void aCheckThatCannotBeKeptIsToldAllTheSame() throws IOException {
        ok(evolve("run"));
        Files.createDirectories(folder.resolve("run/check.json.new/in the way"));

        assertThat(natator("check", "--starts", "2", path("run"))).isEqualTo(1);

        assertThat(out.toString()).contains("mirrored", "verdict");
        assertThat(err.toString()).startsWith("natator check: cannot write ").hasLineCount(1);
    }

    @Test
    void aCheckThatCannotLookAtTheWaterKeepsTheRest() throws IOException {
        ok(evolve("run"));
        Files.createFile(folder.resolve("no-recording"));

        ok(natator("check", "--starts", "2", path("run")));

        assertThat(err.toString()).startsWith("natator check: warning: ").contains("out of luck")
                .endsWith("; how much of the body is under water is left out\n").hasLineCount(1);
        assertThat(out.toString()).contains("mirrored", "verdict").doesNotContain("under water");
        assertThat(file("run", "check.json")).contains("mirrored").doesNotContain("underWater");
    }

    @Test
    void checkNeedsTwoStartsAndARun() throws IOException {
        ok(evolve("run"));
        for (String starts : List.of("1", "0", "2000")) {
            refused(natator("check", "--starts", starts, path("run"))).isEqualTo("natator check: --starts is " + starts
                    + "; expected a whole number from 2 to 1000\n");
        }
        refused(natator("check", folder.toString()));
        assertThat(folder.resolve("run/check.json")).doesNotExist();
    }
}
