package io.natator.cli;

import static io.natator.simulator.Processes.assertThatNoChildIsLeft;
import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.JavaCommand;
import io.natator.config.Json;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.GenerationSummary;
import io.natator.export.ExportFormat;
import io.natator.stream.StreamBytes;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;
import picocli.CommandLine;

/** What {@code natator export} does with its arguments and when things go wrong; what the simulator says is a file. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ExportCommandTest {

    @TempDir
    private Path folder;
    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    @AfterEach
    void nothingRunsOn() throws InterruptedException {
        assertThatNoChildIsLeft();
    }

    /** A simulator that answers `stream` with these bytes and then does what the lines of shell say. */
    private Path simulator(StreamBytes stream, String then) throws IOException {
        Files.write(folder.resolve("said"), stream.toBytes());
        Path script = Files.writeString(folder.resolve("simulator.sh"), "#!/bin/sh\necho \"$@\" >> '" + folder
                + "/arguments'\ncat '" + folder + "/said'\n" + then + "\n");
        assertThat(script.toFile().setExecutable(true)).isTrue();
        return script;
    }

    private static StreamBytes frames(int count) {
        StreamBytes stream = new StreamBytes().json("SCEN", StreamBytes.scene());
        for (int i = 0; i < count; i++) {
            stream.frame(1, i);
        }
        return stream;
    }

    private static StreamBytes whole(int count) {
        return frames(count).json("STOP", "{\"reason\":\"until\"}");
    }

    private int export(Path simulator, String... arguments) {
        CommandLine command = Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true));
        List<String> all = new ArrayList<>(List.of("export", "--simulator-path", simulator.toString()));
        if (!List.of(arguments).contains("--output-dir")) {
            all.addAll(List.of("--output-dir", folder.resolve("out").toString()));
        }
        boolean isPythonUsed = List.of(arguments).contains("usdc") || List.of(arguments).contains("--water-surface");
        if (isPythonUsed && !List.of(arguments).contains("--python")) {
            all.addAll(List.of("--python", System.getProperty("natator.readers")));
        }
        all.addAll(List.of(arguments));
        return command.execute(all.toArray(String[]::new));
    }

    /** A finished run of two generations; the second found something better. */
    private Path run(boolean withEvaluations) throws IOException {
        Path run = Files.createDirectories(folder.resolve("run"));
        Files.writeString(run.resolve("config.json"), """
                {"scene":"thesis/creature-1","encoding":"dense","actuators":2,"population":2,"generations":1,"seed":1,
                 "operators":"corrected","gaussianDeviation":0.05,"scheme":"conserving","duration":3,
                 "overrides":{"solver":{"substeps":8,"viscosity":3}}}""");
        String result = "{\"id\":%d,\"status\":\"ok\",\"distance\":%s,\"simulated\":3,\"frames\":180}";
        String line = "{\"generation\":%d,\"genes\":[%s,0.5,0.5,0.5],\"gait\":{\"frequency\":%s,\"amplitude\":[0.5,0.5],"
                + "\"phase\":[0,0.5]},\"result\":%s}\n";
        if (withEvaluations) {
            Files.writeString(run.resolve("evaluations.jsonl"), line.formatted(0, 1.25, 1.25, result.formatted(0, 0.25))
                    + line.formatted(0, 1.5, 1.5, result.formatted(1, 0.125))
                    + line.formatted(1, 1.75, 1.75, result.formatted(2, 0.5)));
        }
        Files.writeString(run.resolve("checkpoint.json"), Json.document(new EvolutionState(1, 3, List.of(), null,
                Collections.nCopies(2, new GenerationSummary(0, 0, 0, 0, 0, 0, 0, 0, 0)))));
        Files.writeString(run.resolve("best.json"), """
                {"scene":"thesis/creature-1","genes":[1.75,0.5,0.5,0.5],"gait":{"frequency":1.75,"amplitude":[0.5,0.5],
                 "phase":[0,0.5]},"distance":0.5,"speed":0.125,"result":{"id":2,"status":"ok","distance":0.5,"simulated":3}}""");
        return run;
    }

    @Test
    void theNameOfTheSceneIsToldAsItIs() throws IOException {
        ObjectNode scene = StreamBytes.scene().put("scene", "m\u00e9/\u6d77 \"a\"\\b\u001b\n\ud83d\udc1f.json");
        for (String format : List.of("usd", "ply", "glb")) {
            StreamBytes stream = new StreamBytes().json("SCEN", scene).frame(1, 0).json("STOP", "{\"reason\":\"until\"}");
            assertThat(export(simulator(stream, "exit 0"), "test/pool", "--format", format, "--duration", "1", "--output-dir",
                    folder.resolve(format).toString())).as(err.toString()).isZero();
        }

        assertThat(Files.readString(folder.resolve("usd/swim.usda")).lines().filter(line -> line.contains("doc = ")))
                .singleElement().asString().startsWith("    doc = \"m\u00e9/\u6d77 \\\"a\\\"\\\\b??\ud83d\udc1f.json").endsWith("\"");
        assertThat(Files.readString(folder.resolve("glb/swim.glb"), StandardCharsets.ISO_8859_1))
                .contains(new String("m\u00e9/\u6d77 \\\"a\\\"\\\\b??\ud83d\udc1f.json".getBytes(StandardCharsets.UTF_8),
                        StandardCharsets.ISO_8859_1));
        try (Stream<Path> files = Files.walk(folder.resolve("ply"))) {
            assertThat(files.filter(file -> file.toString().endsWith(".ply"))).isNotEmpty().allSatisfy(file ->
                    assertThat(Files.readString(file, StandardCharsets.ISO_8859_1)).contains("comment m?/? \"a\"\\b???.json"));
        }
    }

    @ParameterizedTest
    @EnumSource(ExportFormat.class)
    void everyFormatIsWrittenAndTold(ExportFormat format) throws IOException {
        assertThat(export(simulator(whole(3), "exit 0"), "test/pool", "--format", format.text(), "--duration", "1"))
                .as(err.toString()).isZero();

        boolean bodies = format == ExportFormat.GLB;
        assertThat(out.toString()).isEqualTo(folder.resolve("out")
                + ": 3 frames of " + (bodies ? "bodies alone" : "4 particles of water and 4 others") + System.lineSeparator());
        JsonNode metadata = Json.parse(Files.readString(folder.resolve("out/metadata.json")), JsonNode.class);
        assertThat(metadata.get("water").asBoolean()).isEqualTo(!bodies);
        assertThat(metadata.get("duration").asDouble()).as("what was exported, not the scene's own").isEqualTo(1);
        assertThat(metadata.get("format").asText()).isEqualTo(format.text());
        assertThat(metadata.get("frames").asInt()).isEqualTo(3);
        assertThat(metadata.get("definition")).isEqualTo(StreamBytes.scene().get("definition"));
        assertThat(metadata.get("gait")).isEqualTo(StreamBytes.scene().get("gait"));
        assertThat(metadata.get("program")).isEqualTo(StreamBytes.scene().get("program"));
        try (Stream<Path> files = Files.walk(folder.resolve("out"))) {
            assertThat(files.map(Path::toString)).noneMatch(name -> name.matches(".*(rows|lock|-[0-9]|-extent)$"));
        }
    }

    @Test
    void aRunSwimsByItsBestGaitInItsOwnScene() throws IOException {
        assertThat(export(simulator(whole(1), "exit 0"), run(true).toString(), "--format", "csv", "--every", "4",
                "--overrides", "{\"solver\":{\"viscosity\":5}}", "--fields", "density")).as(err.toString()).isZero();

        assertThat(folder.resolve("arguments")).content().isEqualToIgnoringNewLines("stream thesis/creature-1 "
                + "--overrides {\"solver\":{\"substeps\":8,\"viscosity\":5}} --gait {\"frequency\":1.75,\"amplitude\":"
                + "[0.5,0.5],\"phase\":[0.0,0.5]} --scheme conserving --fields position,density --every 4 --rate 0.0 "
                + "--until 3.0 --lossless");
        JsonNode metadata = Json.parse(Files.readString(folder.resolve("out/metadata.json")), JsonNode.class);
        assertThat(metadata.get("run").asText()).isEqualTo("run");
        assertThat(metadata.get("every").asInt()).isEqualTo(4);
    }

    @Test
    void aGenerationSwimsByTheBestGaitUpToIt() throws IOException {
        assertThat(export(simulator(whole(1), "exit 0"), run(true).toString(), "--format", "csv", "--generation", "0"))
                .as(err.toString()).isZero();

        assertThat(folder.resolve("arguments")).content().contains("\"frequency\":1.25,");
    }

    @Test
    void aRunWithoutItsEvaluationsKnowsOnlyItsBest() throws IOException {
        Path run = run(false);

        assertThat(export(simulator(whole(1), "exit 0"), run.toString(), "--format", "csv", "--generation", "0"))
                .isEqualTo(2);
        assertThat(err.toString()).contains("no longer knows the gaits of generation 0").hasLineCount(1);
        assertThat(export(simulator(whole(1), "exit 0"), run.toString(), "--format", "csv")).isZero();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
        "run --generation 2|--generation is 2; expected one that",
        "run --generation 0 --gait gait.json|--generation and --gait: expected one of them",
        "test/pool --generation 0|--generation: test/pool is not a run folder",
        "none.json|none.json is neither a run folder nor a scene: there is no such file",
        "test/pool --gait none.json|--gait none.json does not exist",
        "test/pool --duration 1 --water-surface|--water-surface and --format csv: expected a format that holds meshes of many shapes",
        "test/pool --python /nope|--python and --format csv: expected --format usdc or --water-surface with it, which alone need a Python",
        "test/pool --fields velocity,velocity|--fields has velocity twice; expected each once",
        "test/pool --every 0|--every is 0; expected a whole number from 1",
        "test/pool --duration 0|--duration is 0.0; expected a number of seconds above 0",
        "test/pool --duration 1e300|--duration is 1.0E300; expected a number of seconds above 0, up to 1000000"})
    void badUsageIsOneLine(String arguments, String message) throws IOException {
        Path run = run(true);
        Files.writeString(folder.resolve("gait.json"), "{\"frequency\":1,\"amplitude\":[1,1],\"phase\":[0,0]}");
        List<String> all = new ArrayList<>(List.of("--format", "csv"));
        for (String argument : arguments.split(" ")) {
            all.add(argument.equals("run") ? run.toString()
                    : argument.equals("gait.json") ? folder.resolve(argument).toString() : argument);
        }

        assertThat(export(simulator(whole(1), "exit 0"), all.toArray(String[]::new))).isEqualTo(2);
        assertThat(err.toString()).contains(message).hasLineCount(1);
        assertThat(folder.resolve("out")).doesNotExist();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
        "exit 1|simulator ended; exit status 1",
        "kill -9 $$|simulator ended; exit status 137",
        "printf 'FRAM'; exit 0|stream ended 4 bytes into the 8-byte head of a message",
        "cat unstable; exit 3|the simulation stopped: {\"reason\":\"unstable\",\"particle\":7,\"time\":0.5}",
        "cat refusal; exit 0|the simulator refused: no credit",
        "exit 0|the simulator ended without a word"})
    void aFailedSimulationLeavesNothing(String then, String message) throws IOException {
        Files.write(folder.resolve("unstable"), new StreamBytes()
                .json("STOP", "{\"reason\":\"unstable\",\"particle\":7,\"time\":0.5}").toBytes());
        Files.write(folder.resolve("refusal"), new StreamBytes()
                .json("ANSW", "{\"id\":null,\"error\":\"no credit\"}").toBytes());
        Path simulator = simulator(frames(3), "cd '" + folder + "'; " + then);

        for (ExportFormat format : ExportFormat.values()) {
            err.getBuffer().setLength(0);
            assertThat(export(simulator, "test/pool", "--format", format.text(), "--duration", "1")).isEqualTo(1);
            assertThat(err.toString()).contains("no export to ").contains(message).hasLineCount(1);
            assertThat(folder.resolve("out")).doesNotExist();
            assertThat(folder.resolve("out.partial")).doesNotExist();
        }
    }

    @Test
    void aLinkIsFollowed() throws IOException {
        Path disk = Files.createDirectory(folder.resolve("disk"));
        Files.createSymbolicLink(folder.resolve("out"), disk);
        Path simulator = simulator(whole(1), "exit 0");
        for (String option : List.of("--no-water", "--force")) {
            assertThat(export(simulator, "test/pool", "--format", "csv", "--duration", "1", option)).as(err.toString()).isZero();
            assertThat(folder.resolve("out")).isSymbolicLink();
            assertThat(disk.resolve("metadata.json")).exists();
        }
    }

    /** Found out before anything is simulated. */
    @Test
    void aPlaceThatTakesNoFolderIsNamed() throws IOException {
        Path simulator = simulator(whole(1), "exit 0");
        Path link = Files.createSymbolicLink(folder.resolve("out"), Path.of("nowhere"));
        Path file = Files.writeString(folder.resolve("file"), "");

        assertThat(export(simulator, "test/pool", "--format", "csv", "--duration", "1")).isEqualTo(2);
        assertThat(err.toString()).isEqualTo("natator export: output folder " + link + " is a link that leads nowhere\n");
        err.getBuffer().setLength(0);
        assertThat(export(simulator, "test/pool", "--format", "csv", "--duration", "1", "--output-dir", file.resolve("a").toString()))
                .isEqualTo(2);
        assertThat(err.toString()).contains(" cannot be made: " + file + " is a file, not a folder").hasLineCount(1);
        assertThat(folder.resolve("arguments")).doesNotExist();
    }

    /** Found out before anything is simulated. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
        "usdc||--format usdc needs the Python package usd-core, which PYTHON cannot import: pip install usd-core",
        "usd|--water-surface|--water-surface needs the Python package pysplashsurf, which PYTHON cannot import: "
            + "pip install pysplashsurf"})
    void aMissingPackageIsNamed(String format, String option, String message) throws IOException {
        Path python = Files.writeString(folder.resolve("python"), "#!/bin/sh\nexit 1\n");
        assertThat(python.toFile().setExecutable(true)).isTrue();
        List<String> arguments = new ArrayList<>(
                List.of("test/pool", "--format", format, "--duration", "1", "--python", python.toString()));
        if (option != null) {
            arguments.add(option);
        }

        assertThat(export(simulator(whole(1), "exit 0"), arguments.toArray(String[]::new))).isEqualTo(2);
        assertThat(err.toString()).contains(message.replace("PYTHON", python.toString())).hasLineCount(1);
        assertThat(folder.resolve("arguments")).doesNotExist();
    }

    @Test
    void bonesNeedABody() throws IOException {
        ObjectNode scene = StreamBytes.scene();
        scene.putArray("slices");
        scene.putArray("joints");
        StreamBytes stream = new StreamBytes().json("SCEN", scene).frame(1, 0).json("STOP", "{\"reason\":\"until\"}");

        assertThat(export(simulator(stream, "exit 0"), "test/pool", "--format", "glb", "--duration", "1")).isEqualTo(2);
        assertThat(err.toString()).contains("--format glb: test/pool has no body with a surface").hasLineCount(1);
        assertThat(folder.resolve("out")).doesNotExist();
    }

    @Test
    void aSurfaceNeedsWater() throws IOException {
        Path python = Files.writeString(folder.resolve("python"), "#!/bin/sh\n");
        assertThat(python.toFile().setExecutable(true)).isTrue();
        ObjectNode scene = StreamBytes.scene();
        scene.putArray("fluid").add(0).add(0);
        StreamBytes stream = new StreamBytes().json("SCEN", scene).frame(1, 0).json("STOP", "{\"reason\":\"until\"}");

        assertThat(export(simulator(stream, "exit 0"), "test/pool", "--format", "usd", "--duration", "1", "--water-surface",
                "--python", python.toString())).isEqualTo(2);
        assertThat(err.toString()).contains("--water-surface: test/pool has no water; expected some").hasLineCount(1);
        assertThat(folder.resolve("out")).doesNotExist();
    }

    @Test
    void aRefusedSceneIsToldInTheSimulatorsWords() throws IOException {
        Path simulator = simulator(new StreamBytes(), "echo 'scene test/pool is not known' >&2; exit 2");

        assertThat(export(simulator, "test/pool", "--format", "npz", "--duration", "1")).isEqualTo(2);
        assertThat(err.toString()).contains("scene test/pool is not known").hasLineCount(1);
    }

    @Test
    void aBodyWithoutMusclesOrWaterIsExportedToo() throws IOException {
        ObjectNode scene = StreamBytes.scene();
        scene.putArray("muscles");
        scene.putArray("fluid").add(0).add(0);
        StreamBytes stream = new StreamBytes().json("SCEN", scene).frame(1, 0).json("STOP", "{\"reason\":\"until\"}");
        Path simulator = simulator(stream, "exit 0");

        for (ExportFormat format : ExportFormat.values()) {
            assertThat(export(simulator, "test/pool", "--format", format.text(), "--duration", "1", "--force",
                    "--no-water")).as(err.toString()).isZero();
        }
        assertThat(out.toString()).contains("1 frame of 0 particles of water and 8 others");
    }

    /** Killed at some moment as by kill -9: nothing has the name of the export; the next one takes its place. */
    @Test
    void aKilledExportLeavesNothingThatLooksComplete() throws IOException, InterruptedException {
        Path target = folder.resolve("out");
        Process process = exportOf50Frames();
        List<ProcessHandle> simulators = process.descendants().toList();
        process.destroyForcibly().waitFor();
        simulators.forEach(ProcessHandle::destroyForcibly);

        assertThat(folder.resolve("out.partial")).isNotEmptyDirectory();
        assertThat(target).doesNotExist();
        assertThat(export(simulator(whole(2), "exit 0"), "test/pool", "--format", "vtp", "--duration", "1"))
                .as(err.toString()).isZero();
        assertThat(target.resolve("water/water_000001.vtp")).exists();
        assertThat(target.resolve("water/water_000049.vtp")).doesNotExist();
        assertThat(folder.resolve("out.partial")).doesNotExist();
    }

    @Test
    void anExportThatIsToldToEndLeavesNothing() throws IOException, InterruptedException {
        Process process = exportOf50Frames();
        process.destroy();
        process.waitFor();

        assertThat(folder.resolve("out")).doesNotExist();
        assertThat(folder.resolve("out.partial")).doesNotExist();
    }

    /** A shell that stands in it would be left in a folder that is gone, and see nothing of the export; an empty one is filled. */
    @Test
    void theCurrentFolderIsFilledButNotReplaced() throws IOException, InterruptedException {
        Path current = Files.createDirectory(folder.resolve("out")).toRealPath();
        Path simulator = simulator(whole(1), "exit 0");
        assertThat(exportTo(".", simulator).directory(current.toFile()).start().waitFor()).as(Files.readString(folder.resolve("log"))).isZero();
        assertThat(current.resolve("metadata.json")).exists();
        Files.delete(folder.resolve("arguments"));

        for (List<String> options : List.of(List.of("--force"), List.<String>of())) {
            ProcessBuilder again = exportTo(".", simulator);
            again.command().addAll(options);
            assertThat(again.directory(current.toFile()).start().waitFor()).isEqualTo(2);
            assertThat(Files.readString(folder.resolve("log"))).isEqualTo("natator export: output folder . is the current folder, or holds it; "
                    + "expected another, such as " + current.resolve("swim") + "\n");
        }
        assertThat(folder.resolve("out.partial")).doesNotExist();
        assertThat(folder.resolve("arguments")).doesNotExist();
    }

    private ProcessBuilder exportTo(String target, Path simulator) {
        return new ProcessBuilder(JavaCommand.of(Main.class, "export", "test/pool", "--format", "vtp", "--duration", "1",
                "--simulator-path", simulator.toString(), "--output-dir", target))
                .redirectErrorStream(true).redirectOutput(folder.resolve("log").toFile());
    }

    /** An export that has written as many frames and waits for more. */
    private Process exportOf50Frames() throws IOException, InterruptedException {
        Process process = exportTo(folder.resolve("out").toString(), simulator(frames(50), "sleep 3600")).start();
        Path last = folder.resolve("out.partial/water/water_000049.vtp");
        while (process.isAlive() && !Files.exists(last)) {
            Thread.sleep(10);
        }
        assertThat(last).as(Files.readString(folder.resolve("log"))).exists();
        return process;
    }
}
