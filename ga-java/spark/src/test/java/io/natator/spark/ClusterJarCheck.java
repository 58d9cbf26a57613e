package io.natator.spark;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.cli.Main;
import io.natator.process.FakeSimulator;
import io.natator.process.Processes;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.io.Writer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;

/** The packaged jar on a cluster of a master and two workers: same bits as on one machine, whatever is killed. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ClusterJarCheck {

    private static final Path REAL = Path.of(System.getProperty("natator.simulator")).toAbsolutePath().normalize();
    private static final List<String> RESULTS = List.of("generations.csv", "best.json", "checkpoint.json",
            "evaluations.jsonl", "results.json");

    @TempDir
    private static Path shared;
    private static TestCluster cluster;

    @TempDir
    private Path folder;
    private Path log;
    private Path fake;
    private long turns;

    @BeforeAll
    static void startCluster() throws IOException, InterruptedException {
        cluster = new TestCluster(shared);
        for (int gpu = 5; gpu <= 6; gpu++) {
            Path discovery = FakeSimulator.program(shared.resolve("gpu-" + gpu),
                    "#!/bin/sh\necho '{\"name\":\"gpu\",\"addresses\":[\"" + gpu + "\"]}'\n");
            cluster.addWorker(Map.of(), List.of("-Dspark.worker.resource.gpu.amount=1",
                    "-Dspark.worker.resource.gpu.discoveryScript=" + discovery), "");
        }
    }

    @AfterAll
    static void stopCluster() {
        cluster.close();
    }

    /** The fake simulator behind a script that can be sent anywhere. */
    @BeforeEach
    void fake() throws IOException {
        FakeSimulator.in(folder);
        log = folder.resolve("log.txt");
        fake = script("exec FOLDER/fake-simulator.sh \"$@\"");
    }

    @AfterEach
    void nothingIsLeft() throws IOException, InterruptedException {
        Processes.await("executors end with their driver", () -> cluster.executors().isEmpty());
        Processes.await("native programs end with their executors", () -> ProcessHandle.allProcesses()
                .noneMatch(process -> process.info().arguments().map(List::of).orElse(List.of())
                        .contains(folder.resolve("fake-simulator.sh").toString())));
    }

    private Path script(String text) throws IOException {
        return FakeSimulator.program(folder.resolve("simulator"),
                "#!/bin/bash\n" + text.replace("FOLDER", folder.toString()) + "\n");
    }

    /** A run on this machine, a process for each evaluation. */
    private void alone(Path simulator, Path run, String... settings) {
        StringWriter said = new StringWriter();
        List<String> arguments = new ArrayList<>(
                List.of("evolve", "--no-cache", "--simulator", "process", "--simulator-path",
                        simulator.toString(), "--output-dir", run.toString()));
        arguments.addAll(List.of(settings));
        CommandLine command = Main.commandLine().setOut(new PrintWriter(said)).setErr(new PrintWriter(said));
        assertThat(command.execute(arguments.toArray(String[]::new))).as(said.toString()).isZero();
    }

    private Process evolve(Path simulator, Path run, List<String> configuration, String... settings)
            throws IOException {
        List<String> arguments = new ArrayList<>(
                List.of("evolve", "--no-cache", "--simulator-path", simulator.toString(),
                        "--output-dir", run.toString(), "--timeout", "3600"));
        arguments.addAll(List.of(settings));
        return cluster.submit(log, configuration, arguments.toArray(String[]::new));
    }

    private void assertSucceeds(Process driver) throws InterruptedException, IOException {
        assertThat(driver.waitFor()).as(Files.readString(log)).isZero();
    }

    private static void assertSame(Path run, Path other) {
        for (String name : RESULTS) {
            if (Files.exists(other.resolve(name))) {
                assertThat(run.resolve(name)).hasSameBinaryContentAs(other.resolve(name));
            }
        }
        assertThat(run.resolve("evaluations.jsonl")).exists();
    }

    private static long evaluations(Path run) throws IOException {
        Path file = run.resolve("evaluations.jsonl");
        return Files.exists(file) ? Files.readString(file, StandardCharsets.ISO_8859_1).lines().count() : 0;
    }

    /** The scene is a file of this machine that builds on another; executors have neither. */
    @Test
    void theRealSimulatorGivesTheSameBits() throws IOException, InterruptedException {
        Path scene = folder.resolve("mine.json");
        Files.writeString(scene, "{\"base\":\"thesis/creature-1\"}");
        String[] settings = {"--scene", scene.toString(), "--duration", "0.05", "--starts", "1", "--population", "8",
                "--generations", "1", "--seed", "7"};
        alone(REAL, folder.resolve("alone"), settings);

        assertSucceeds(evolve(REAL, folder.resolve("run"), List.of(), settings));

        assertSame(folder.resolve("run"), folder.resolve("alone"));
        assertThat(Files.readString(folder.resolve("run/environment.json"))).contains("\"mode\" : \"spark\"");
    }

    /** Each is killed while generations are under way; then the driver, which is continued by another. */
    @Test
    void killedExecutorsAndAKilledDriverChangeNothing() throws IOException, InterruptedException {
        Path run = folder.resolve("run");
        Process driver = beginInTurns(run, 40, 4);
        long before = 0;
        for (int kill = 0; kill < 2; kill++) {
            before = killAnExecutor(run, before + 10, kill);
        }
        awaitEvaluations(run, before + 5);
        assertThat(driver.isAlive()).as(Files.readString(log)).isTrue();
        driver.destroyForcibly().waitFor();
        long logged = evaluations(run);
        assertThat(logged).isLessThan(evaluations(folder.resolve("alone")));
        Files.delete(folder.resolve("turns"));

        assertSucceeds(resume(run));

        assertSame(run, folder.resolve("alone"));
    }

    /** There are evaluations only while they are waited for: no run gets to its end before it is looked at. */
    private Process beginInTurns(Path run, int population, int generations) throws IOException {
        String[] settings = {"--scene", "thesis/creature-1", "--starts", "1", "--population", "" + population,
                "--generations", "" + generations, "--seed", "3"};
        alone(fake, folder.resolve("alone"), settings);
        Files.writeString(folder.resolve("turns"), "0\n");
        return evolve(fake, run, List.of(), settings);
    }

    private Process resume(Path run) throws IOException {
        return cluster.submit(log, List.of(), "resume", "--no-cache", "--timeout", "3600", "--simulator-path",
                fake.toString(), run.toString());
    }

    private void awaitEvaluations(Path run, long count) throws IOException, InterruptedException {
        Processes.await(count + " evaluations", () -> {
            if (turns == 0 || Files.exists(folder.resolve("seen-turn-" + (turns - 1)))) {
                Files.writeString(folder.resolve("turns"), ++turns + "\n");
            }
            return evaluations(run) >= count;
        });
    }

    private long killAnExecutor(Path run, long after, int which) throws IOException, InterruptedException {
        awaitEvaluations(run, after);
        Processes.await("executors", () -> !cluster.executors().isEmpty());
        List<ProcessHandle> executors = cluster.executors();
        assertThat(executors.get(which % executors.size()).destroyForcibly()).isTrue();
        return evaluations(run);
    }

    /** Fifty, or as many as {@code -Dspark.kills=N} says; the driver is killed at each tenth of them. */
    @Test
    @Tag("nightly")
    void fiftyKillsChangeNothing() throws IOException, InterruptedException {
        Path run = folder.resolve("run");
        Process driver = beginInTurns(run, 150, 12);
        long before = 0;
        for (int kill = 0; kill < Integer.getInteger("spark.kills", 50); kill++) {
            before = killAnExecutor(run, before + 10, kill);
            assertThat(driver.isAlive()).as(Files.readString(log)).isTrue();
            if (kill % 10 == 9) {
                driver.destroyForcibly().waitFor();
                Processes.await("executors end with their driver", () -> cluster.executors().isEmpty());
                driver = resume(run);
            }
        }
        Files.delete(folder.resolve("turns"));
        assertSucceeds(driver);

        assertSame(run, folder.resolve("alone"));
    }

    /** One worker answers nonsense, one has no room for files, one hangs: the others do the work. */
    @Test
    @Tag("nightly")
    void machinesThatCannotAreLeftOut() throws IOException, InterruptedException {
        String[] settings = {"--scene", "thesis/creature-1", "--starts", "1", "--population", "40", "--generations",
                "1", "--seed", "3"};
        Path simulator = script("if [[ -n $TEST_NONSENSE && $1 != info ]]; then echo nonsense; exit; fi\n"
                + "if [[ -n $TEST_HANG && $1 = serve ]]; then sleep 3600; fi\nexec FOLDER/fake-simulator.sh \"$@\"");
        alone(simulator, folder.resolve("alone"), settings);
        Files.writeString(folder.resolve("slow"), "0.03");
        Process nonsense = cluster.addWorker(Map.of("TEST_NONSENSE", "1"), List.of(), "");
        Process full = cluster.addWorker(Map.of(), List.of(), "ulimit -f 4000;");
        Process hanging = cluster.addWorker(Map.of("TEST_HANG", "1"), List.of(), "");
        try {
            assertSucceeds(evolve(simulator, folder.resolve("run"), List.of("spark.speculation.minTaskRuntime=500ms",
                    "spark.speculation.task.duration.threshold=500ms"), settings));
        } finally {
            List.of(nonsense, full, hanging).forEach(Process::destroy);
        }

        assertSame(folder.resolve("run"), folder.resolve("alone"));
        assertThat(Files.readString(log))
                .containsPattern("executor \\d+ on 127.0.0.\\d: swims otherwise than the driver "
                        + "\\(hash none: no valid result: .*; it gets no more work, others do its evaluations")
                .containsPattern("executor \\d+ .*: .*File too large");
    }

    /** As many as there are seeds, in no order. */
    @Test
    @Tag("nightly")
    void evolutionsAtTheSameTimeShareTheCluster() throws IOException, InterruptedException {
        List<String> settings = List.of("--no-cache", "--simulator-path", fake.toString(), "--seeds", "4",
                "--evaluations", "30", "--scene", "thesis/creature-1", "--output-dir");
        List<String> arguments = new ArrayList<>(List.of("evolve", "--simulator", "process"));
        arguments.addAll(settings);
        arguments.add(folder.resolve("alone").toString());
        assertThat(Main.commandLine().setOut(new PrintWriter(Writer.nullWriter()))
                .setErr(new PrintWriter(Writer.nullWriter())).execute(arguments.toArray(String[]::new))).isZero();
        arguments = new ArrayList<>(List.of("evolve"));
        arguments.addAll(settings);
        arguments.add(folder.resolve("run").toString());

        assertSucceeds(cluster.submit(log, List.of(), arguments.toArray(String[]::new)));

        for (String name : List.of("seed-1", "seed-2", "seed-3", "seed-4")) {
            assertSame(folder.resolve("run").resolve(name), folder.resolve("alone").resolve(name));
        }
    }

    @Test
    void anotherInstructionSetIsRefusedInOneLine() throws IOException, InterruptedException {
        Process driver = evolve(REAL, folder.resolve("run"), List.of("spark.executorEnv.NATATOR_ISA=portable",
                "spark.scheduler.excludeOnFailure.unschedulableTaskSetTimeout=1s"), "--population", "4",
                "--generations", "0",
                "--duration", "0.1");

        assertThat(driver.waitFor()).as(Files.readString(log)).isEqualTo(2);

        assertThat(Files.readAllLines(log)).filteredOn(line -> line.startsWith("natator evolve: ")).singleElement()
                .asString().matches(
                        "natator evolve: simulator: no executor can do it; executor \\d on 127.0.0.\\d: instruction set is "
                                + "portable, the driver's is .*: last digits would differ; set NATATOR_ISA for all to what all have");
    }

    /** No worker has that much memory, of which Spark itself says little. */
    @Test
    @Tag("nightly")
    void waitingForExecutorsIsToldOf() throws IOException, InterruptedException {
        Process driver = evolve(fake, folder.resolve("run"), List.of("spark.executor.memory=40g"), "--creature", "1");
        try {
            Processes.await("a line about it",
                    () -> Files.readString(log).contains("no executor for 30 s; are there workers at "
                            + cluster.master() + " with enough free memory (40g, --executor-memory) and cores?"));
        } finally {
            driver.destroyForcibly().waitFor();
        }
    }

    /** Each worker has a GPU of its own number; a task is a batch on the one that Spark gave it. */
    @Test
    @Tag("nightly")
    void gpusAreResourcesOfSpark() throws IOException, InterruptedException {
        Path simulator = script("""
                if [[ $1 = info && $2 = --json ]]; then
                    echo '{"version":"0.1.0","instructionSet":"any","devices":["5: NVIDIA T","6: NVIDIA T"]}'; exit
                fi
                if [[ $1 = serve ]]; then echo "$*" >>FOLDER/started; exec FOLDER/fake-simulator.sh serve; fi
                exec FOLDER/fake-simulator.sh "$@\"""");
        String[] settings = {"--scene", "thesis/creature-1", "--starts", "1", "--population", "30", "--generations",
                "1", "--seed", "3", "--backend", "cuda"};
        alone(simulator, folder.resolve("alone"), settings);
        Files.writeString(folder.resolve("slow"), "0.02");

        assertSucceeds(
                evolve(simulator, folder.resolve("run"), List.of("spark.executor.resource.gpu.amount=1"), settings));

        assertSame(folder.resolve("run"), folder.resolve("alone"));
        assertThat(Files.readAllLines(folder.resolve("started"))).containsExactlyInAnyOrder(
                "serve --backend cuda --device 5", "serve --backend cuda --device 6");
    }
}
