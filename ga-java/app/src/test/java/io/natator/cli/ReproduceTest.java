package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assumptions.assumeThat;

import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.StoredRun;
import io.natator.simulator.ProgramInfo;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.LocalDate;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;

/** The whole study in miniature, with the real simulator. */
class ReproduceTest {

    private static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize();

    @TempDir
    private Path folder;
    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    private int reproduce(String... more) {
        CommandLine command = Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true));
        List<String> all = new ArrayList<>(List.of("reproduce", "--simulator-path", SIMULATOR.toString(), "--seeds", "1",
                "--population", "4", "--duration", "0.05", "--output-dir", folder.toString()));
        all.addAll(List.of(more));
        return command.execute(all.toArray(String[]::new));
    }

    @Test
    void evolvesInABatchWhatIsNotFinished() throws IOException {
        List<String> options = List.of("--creature", "1", "--generations", "1", "--phase", "evolve", "--simulator", "batch",
                "--compact");

        assertThat(reproduce(options.toArray(String[]::new))).as(err.toString()).isZero();

        for (String run : List.of("runs/creature-1/flex/seed-1", "runs/creature-1/open-water/seed-1")) {
            StoredRun stored = StoredRun.in(folder.resolve(run));
            assertThat(StoredRun.isFinished(folder.resolve(run))).isTrue();
            assertThat(stored.state().history()).hasSize(2);
            assertThat(stored.best().result().scheme()).isEqualTo(run.contains("flex") ? "flex" : "conserving");
            assertThat(folder.resolve(run).resolve("evaluations.jsonl")).doesNotExist();
            assertThat(Files.readString(folder.resolve(run).resolve("finalists.json"))).contains("\"gaits\"", "\"score\"", "\"amplitude\"");
        }
        String environment = Files.readString(folder.resolve("runs/creature-1/flex/seed-1/environment.json"));
        assertThat(reproduce(options.toArray(String[]::new))).isZero();
        assertThat(folder.resolve("runs/creature-1/flex/seed-1/environment.json")).hasContent(environment);
    }

    /** What is left of a compact run is enough, and so many generations as it has are kept where none are asked for. */
    @Test
    void aFinishedEvolutionGoesOnToMoreGenerations() throws IOException {
        Path run = folder.resolve("runs/creature-1/flex/seed-1");
        List<String> options = List.of("--creature", "1", "--water", "flex", "--phase", "evolve", "--simulator", "batch", "--compact");
        for (String generations : List.of("1", "3")) {
            assertThat(reproduce(Stream.concat(options.stream(), Stream.of("--generations", generations)).toArray(String[]::new)))
                    .as(err.toString()).isZero();
            assertThat(Files.readString(run.resolve("finalists.json"))).contains("\"generation\" : " + generations);
        }
        assertThat(reproduce(options.toArray(String[]::new))).isZero();
        List<String> parts = Files.readAllLines(run.resolve("generations.csv"));

        RunFolder.delete(run);
        Files.delete(run.resolve("finalists.json"));
        assertThat(reproduce(Stream.concat(options.stream(), Stream.of("--generations", "3")).toArray(String[]::new))).isZero();
        assertThat(Files.readAllLines(run.resolve("generations.csv"))).isEqualTo(parts).hasSize(5);

        Path config = run.resolve("config.json");
        Files.writeString(config, Files.readString(config).replace("\"duration\" : 0.05", "\"duration\" : 0.1"));
        err.getBuffer().setLength(0);
        assertThat(reproduce(Stream.concat(options.stream(), Stream.of("--generations", "4")).toArray(String[]::new))).isEqualTo(2);
        assertThat(err.toString()).endsWith("natator reproduce: " + config + " was edited after the run was begun: duration was 0.05, is now 0.1; "
                + "expected the settings that it was begun with, or a new run\n");
    }

    @Test
    void anEvolutionWhoseSceneWasChangedIsRefusedAndLeftAsItIs() throws IOException {
        List<String> options = List.of("--creature", "1", "--water", "flex", "--phase", "evolve", "--compact");
        assertThat(reproduce(Stream.concat(options.stream(), Stream.of("--generations", "0")).toArray(String[]::new))).as(err.toString()).isZero();
        Path run = folder.resolve("runs/creature-1/flex/seed-1");
        Path environment = run.resolve("environment.json");
        Files.writeString(environment, Files.readString(environment).replaceFirst("(\"sceneSha256\" : \")\\w+", "$10"));
        Map<String, String> before = files(run);
        err.getBuffer().setLength(0);

        assertThat(reproduce(Stream.concat(options.stream(), Stream.of("--generations", "1")).toArray(String[]::new))).isEqualTo(2);

        assertThat(err.toString()).endsWith("natator reproduce: scene thesis/creature-1 was changed after " + run + " was begun; "
                + "expected the scene that it was begun with, or a new run\n");
        assertThat(files(run)).isEqualTo(before);
    }

    private static Map<String, String> files(Path directory) throws IOException {
        Map<String, String> content = new TreeMap<>();
        try (Stream<Path> all = Files.walk(directory)) {
            for (Path file : all.filter(Files::isRegularFile).toList()) {
                content.put(file.toString(), Files.readString(file, StandardCharsets.ISO_8859_1));
            }
        }
        return content;
    }

    @Test
    void reportsOnARunOfOnesOwn() throws IOException {
        assertThat(reproduce("--creature", "2", "--water", "flex", "--generations", "0", "--phase", "evolve"))
                .as(err.toString()).isZero();
        Path run = folder.resolve("runs/creature-2/flex/seed-1");
        CommandLine command = Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true));

        assertThat(command.execute("report", "--simulator-path", SIMULATOR.toString(), run.toString()))
                .as(err.toString()).isZero();

        assertThat(Files.readString(run.resolve("report/README.md"))).contains("# thesis/creature-2, seed 1",
                "![rotation over time](rotation.png)", "flow-side.png", "| e against anguilliform fish (α, β) | 0.")
                .doesNotContain("NaN", "not finished");

        Path config = run.resolve("config.json");
        Files.writeString(config, Files.readString(config).replaceFirst("\"generations\" : 0", "\"generations\" : 3"));
        assertThat(command.execute("report", "--simulator-path", SIMULATOR.toString(), run.toString()))
                .as(err.toString()).isZero();
        assertThat(Files.readString(run.resolve("report/README.md")))
                .startsWith("# thesis/creature-2, seed 1\n\n**This run is not finished.** Done are generation 0 of 3 and ");
        assertThat(command.execute("report", folder.toString())).isEqualTo(2);
        assertThat(err.toString()).contains("is not a run folder");
    }

    @Test
    void saysHowLongItWillTakeAndDoesNothing() {
        assertThat(reproduce("--creature", "1", "--water", "flex", "--generations", "100", "--dry-run")).isZero();

        assertThat(out.toString()).contains("1 evolution, ").contains("about 1570 evaluations left")
                .contains("creature 1, flex").containsPattern("about .*, with ");
        assertThat(out.toString()).containsPattern("\\d{3,4} evaluations to measure, 0 gaits to run at half the spacing and \\d{2} runs to record");
        assertThat(folder).isEmptyDirectory();
    }

    /** What is committed is what the present program makes, by a sample that is another one every day. */
    @Test
    void committedRunsEndWithTheSameBits() throws IOException, InterruptedException {
        assumeThat(ProgramInfo.of(SIMULATOR).instructionSet()).as("the others round otherwise").startsWith("avx");
        Path committed = Path.of("../../results/thesis/processor.jsonl");
        Files.copy(committed, folder.resolve("processor.jsonl"));
        List<String> sample = List.of("--water", "flex", "--phase", "repeat", "--sample", "3", "--sample-seed",
                "" + LocalDate.now().getDayOfYear(), "--runs", "8");

        assertThat(repeat(sample)).as(out.toString()).isZero();
        assertThat(out.toString()).contains("3 of 3 runs end with the same bits");

        String rows = Files.readString(committed);
        Files.writeString(folder.resolve("processor.jsonl"), rows.replaceAll("\"hash\":\"[0-9a-f]{4}", "\"hash\":\"0000"));
        assertThat(repeat(sample)).isEqualTo(1);
        assertThat(out.toString()).contains("differs: {", "0 of 3 runs end with the same bits");
    }

    /** A page tells how to make what it is of, and more seeds than are usual are kept. */
    @Test
    void thePageHasTheCommandsThatMakeIt() throws IOException {
        Path study = folder.resolve("my study");
        Path run = Files.createDirectories(study.resolve("runs/creature-1/flex/seed-4"));
        for (String name : List.of("config.json", "checkpoint.json", "best.json", "finalists.json")) {
            Files.copy(Path.of("../../results/thesis/runs/creature-1/flex/seed-1").resolve(name), run.resolve(name));
        }
        String same = "java -jar ga-java/target/natator.jar reproduce ";
        String rest = " --creature 1 --output-dir '" + study + "'\n";

        int generations = StoredRun.settings(run).generations();

        String page = page(study, "--creature", "1");
        assertThat(page).contains("- 1 of 7 evolutions are finished", "```\n" + same + "--water flex --seeds 4 --generations " + generations + rest
                + same + "--water open-water --seeds 3 --generations 25" + rest + same + "--phase report" + rest + "```\n",
                "`--phase report` builds page and pictures anew from the rows, in seconds", "a row's `request`, given to `natator-sim evaluate`,")
                .doesNotContain("recompute.py");
        assertThat(page(study, "--creature", "1", "--water", "flex")).contains("- 1 of 4 evolutions are finished",
                "```\n" + same + "--water flex --seeds 4 --generations " + generations + rest + "```\n");

        Files.writeString(study.resolve("recompute.py"), "");
        assertThat(page(study, "--creature", "1", "--generations", "9", "--seeds", "3")).contains("- 0 of 6 evolutions are finished",
                "```\n" + same + "--seeds 3 --generations 9" + rest + "```\n", "`python3 '" + study.resolve("recompute.py") + "' --entries 0` works ");
    }

    /** Creatures of unlike generations each have a line. */
    @Test
    void thePageHasACommandForEachNumberOfGenerations() throws IOException {
        for (int creature : List.of(1, 2, 3)) {
            Path committed = Path.of("../../results/thesis/runs/creature-" + creature + "/flex/seed-1");
            Path run = Files.createDirectories(folder.resolve("runs/creature-" + creature + "/flex/seed-1"));
            for (String name : List.of("config.json", "checkpoint.json", "best.json", "finalists.json")) {
                Files.copy(committed.resolve(name), run.resolve(name));
            }
        }
        int generations = StoredRun.settings(folder.resolve("runs/creature-1/flex/seed-1")).generations();
        Path config = folder.resolve("runs/creature-2/flex/seed-1/config.json");
        String fewer = Files.readString(config).replace("\"generations\" : " + generations, "\"generations\" : " + (generations - 1));
        Files.writeString(config, fewer);
        String same = "java -jar ga-java/target/natator.jar reproduce ";
        String rest = " --output-dir " + folder + "\n";

        assertThat(page(folder, "--creature", "1,2,3", "--water", "flex", "--seeds", "1")).contains("```\n"
                + same + "--water flex --creature 1,3 --seeds 1 --generations " + generations + rest
                + same + "--water flex --creature 2 --seeds 1 --generations " + (generations - 1) + rest
                + same + "--phase report --creature 1,2,3" + rest + "```\n");
    }

    private String page(Path study, String... options) throws IOException {
        CommandLine command = Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true));
        List<String> all = new ArrayList<>(List.of("reproduce", "--simulator-path", SIMULATOR.toString(), "--phase", "report", "--output-dir",
                study.toString()));
        all.addAll(List.of(options));
        assertThat(command.execute(all.toArray(String[]::new))).as(err.toString()).isZero();
        return Files.readString(study.resolve("README.md"));
    }

    private int repeat(List<String> options) {
        CommandLine command = Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true));
        List<String> all = new ArrayList<>(List.of("reproduce", "--simulator-path", SIMULATOR.toString(), "--output-dir", folder.toString()));
        all.addAll(options);
        return command.execute(all.toArray(String[]::new));
    }

    @Test
    void refusesWhatIsNotThere() {
        assertThat(reproduce("--creature", "5")).isEqualTo(2);
        assertThat(err.toString()).contains("--creature has 5; expected 1, 2, 3 or 4");
        assertThat(reproduce("--seeds", "0", "--creature", "1")).isEqualTo(2);
    }

    /** Before it plans, let alone evolves for days. */
    @ParameterizedTest
    @CsvSource({"README.md, --dry-run", "README.md, --phase=all", "motions.jsonl, --dry-run"})
    void refusesAFolderFirst(String file, String option) throws IOException {
        Files.writeString(folder.resolve(file), "my own\nmy own\n");

        assertThat(reproduce("--creature", "1", "--water", "flex", option)).isEqualTo(2);

        assertThat(out.toString()).isEmpty();
        assertThat(err.toString()).contains(file).hasLineCount(1);
        assertThat(folder.resolve("runs")).doesNotExist();
    }
}
