package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assumptions.assumeThat;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.JavaCommand;
import io.natator.stream.StreamBytes;
import java.io.File;
import java.io.IOException;
import java.io.OutputStream;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;

/**
 * Exports of the real simulator, read back by pyvista, plyfile, USD, pygltflib and numpy in {@code tests/readers/check_export.py},
 * which compares every number with the simulator's own stream.
 */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ExportReadersTest {

    private static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize();
    private static final Path READERS = Path.of(System.getProperty("natator.readers")).normalize();
    private static final Path CHECK =
            Path.of(System.getProperty("natator.protocol"), "../../tests/readers/check_export.py").normalize();
    private static final String GAIT = "{\"frequency\":%s,\"amplitude\":[%s],\"phase\":[%s]}";

    /** Streams that several tests compare exports with, by the simulator's arguments. */
    private static final Map<List<String>, Path> STREAMS = new HashMap<>();

    @TempDir
    private static Path shared;

    @TempDir
    private Path folder;

    @BeforeAll
    static void readersAreInstalled() {
        assertThat(READERS).as("the readers of exports are missing; install them by: ./setup.sh --readers")
                .isExecutable();
        assertThat(SIMULATOR).as("built by: cmake --preset release && cmake --build --preset release").isExecutable();
    }

    @BeforeAll
    static void gaits() throws IOException {
        Files.writeString(shared.resolve("two.json"), GAIT.formatted("1.861", "0.973,0.690", "0,0.648"));
        Files.writeString(shared.resolve("three.json"), GAIT.formatted("1.761", "0.863,0.503,0.271", "0,0.176,0.729"));
        Files.writeString(shared.resolve("five.json"), GAIT.formatted("1.5", "1,1,1,1,1", "0,0.92,0.84,0.76,0.68"));
    }

    /** Of one of these files. */
    private static String gait(String name) {
        return shared.resolve(name + ".json").toString();
    }

    private int run(File output, String... command) throws IOException, InterruptedException {
        return new ProcessBuilder(command).redirectErrorStream(true).redirectOutput(output).start().waitFor();
    }

    /** What the simulator writes, byte for byte, all fields and frames. */
    private static Path stream(double until, String... scene) throws IOException, InterruptedException {
        List<String> command = new ArrayList<>(List.of(SIMULATOR.toString(), "stream", "--fields",
                "position,velocity,density", "--rate", "0", "--lossless", "--until", "" + until));
        command.addAll(List.of(scene));
        Path known = STREAMS.get(command);
        if (known != null) {
            return known;
        }
        Path file = shared.resolve(STREAMS.size() + ".stream");
        Process process = new ProcessBuilder(command).redirectOutput(file.toFile())
                .redirectError(ProcessBuilder.Redirect.INHERIT).start();
        try (OutputStream commands = process.getOutputStream()) {
            commands.write("{\"do\":\"credit\",\"frames\":1000}\n".getBytes(StandardCharsets.UTF_8));
            commands.flush();
            assertThat(process.waitFor()).isZero();
        }
        STREAMS.put(command, file);
        return file;
    }

    private Path export(String format, double until, String... arguments) {
        return export(SIMULATOR, format, until, arguments);
    }

    private Path export(Path simulator, String format, double until, String... arguments) {
        Path target = folder.resolve(format);
        List<String> all = new ArrayList<>(List.of("export", "--format", format, "--duration", "" + until,
                "--simulator-path", simulator.toString(), "--output-dir", target.toString()));
        all.addAll(List.of(arguments));
        if (format.equals("usdc") || all.contains("--water-surface")) {
            all.addAll(List.of("--python", READERS.toString()));
        }
        StringWriter said = new StringWriter();
        CommandLine command = Main.commandLine().setOut(new PrintWriter(said, true)).setErr(new PrintWriter(said, true));
        assertThat(command.execute(all.toArray(String[]::new))).as(said.toString()).isZero();
        return target;
    }

    private String check(int status, Path stream, Path export) throws IOException, InterruptedException {
        Path log = folder.resolve("check.log");
        int found = run(log.toFile(), READERS.toString(), CHECK.toString(), stream.toString(), export.toString());
        String said = Files.readString(log);
        assertThat(found).as(said).isEqualTo(status);
        return said;
    }

    @ParameterizedTest
    @CsvSource({"vtp, 500000", "ply, 400000", "usd, 300000", "usdc, 300000", "csv, 400000", "npz, 300000",
        "glb, 5000"})
    void everyNumberOfASwimIsReadBack(String format, long atLeast) throws IOException, InterruptedException {
        Path stream = stream(0.1, "thesis/creature-1", "--gait", gait("two"));

        String said = check(0, stream, export(format, 0.1, "thesis/creature-1", "--gait", gait("two")));

        assertThat(said).startsWith(format).endsWith("numbers equal in 7 frames\n");
        assertThat(Long.parseLong(said.split("[: ]+")[1])).isGreaterThan(atLeast);
    }

    /** Slices of many sizes, every third frame, another scheme, changed settings. */
    @ParameterizedTest
    @CsvSource({"vtp", "ply", "usd", "usdc", "glb", "csv", "npz"})
    void theBodyAloneAndFewerFieldsAndFrames(String format) throws IOException, InterruptedException {
        String[] swim = {"thesis/creature-4", "--gait", gait("three"), "--scheme",
            "conserving", "--overrides", "{\"solver\":{\"substeps\":2,\"viscosity\":3}}"};
        List<String> arguments = new ArrayList<>(List.of(swim));
        arguments.addAll(List.of("--no-water", "--every", "3", "--fields", "position"));

        String said = check(0, stream(0.2, swim), export(format, 0.2, arguments.toArray(String[]::new)));

        assertThat(said).endsWith("numbers equal in 5 frames\n");
    }

    @ParameterizedTest
    @CsvSource({"vtp", "ply", "usd", "usdc", "csv", "npz"})
    void waterWithoutABody(String format) throws IOException, InterruptedException {
        check(0, stream(0.05, "thesis/tank"), export(format, 0.05, "thesis/tank"));
    }

    /** Particles that are held in place, and solids of no body, in a stream made for it. */
    @ParameterizedTest
    @CsvSource({"vtp", "ply", "usd", "csv", "npz"})
    void particlesOfEveryKind(String format) throws IOException, InterruptedException {
        ObjectNode scene = StreamBytes.scene();
        scene.putArray("body").add(4).add(5).add(6);
        scene.putArray("slices");
        scene.putArray("joints");
        scene.putArray("clusters").addArray().add(5).add(6);
        StreamBytes stream = new StreamBytes().json("SCEN", scene).frame(1, 0).frame(1, 1).frame(1, 2)
                .json("STOP", "{\"reason\":\"until\"}");
        Path file = Files.write(folder.resolve("made.stream"), stream.toBytes());
        Path program = Files.writeString(folder.resolve("simulator.sh"), "#!/bin/sh\ncat '" + file + "'\n");
        assertThat(program.toFile().setExecutable(true)).isTrue();

        check(0, file, export(program, format, 1, "test/pool"));
    }

    /** Two companions, whose particles, clusters and surfaces are told apart from the swimmer's. */
    @ParameterizedTest
    @CsvSource({"vtp", "ply", "usd", "glb", "npz"})
    void severalCreatures(String format) throws IOException, InterruptedException {
        check(0, stream(0.02, "company/school"), export(format, 0.02, "company/school"));
    }

    @Test
    void obstaclesAreNoCreatures() throws IOException, InterruptedException {
        check(0, stream(0.02, "company/pillars"), export("usd", 0.02, "company/pillars"));
    }

    /** A closed mesh around the water in every frame, between the tank's walls. */
    @ParameterizedTest
    @CsvSource({"vtp", "ply", "usd", "usdc"})
    void theWatersSurface(String format) throws IOException, InterruptedException {
        String[] swim = {"pool/creature-1", "--gait", gait("two")};
        List<String> arguments = new ArrayList<>(List.of(swim));
        arguments.addAll(List.of("--water-surface", "--every", "5", "--fields", "position"));

        check(0, stream(0.1, swim), export(format, 0.1, arguments.toArray(String[]::new)));
    }

    /** A mesh as skin, moved by bones; found good by the validator of glTF where there is one. */
    @Test
    void aSkinHasBones() throws IOException, InterruptedException {
        String[] swim = {"pool/ray", "--gait", gait("five")};

        Path export = export("glb", 0.1, swim);

        check(0, stream(0.1, swim), export);
        validate(export.resolve("swim.glb"));
    }

    @Test
    void theValidatorOfGltfFindsNothing() throws IOException, InterruptedException {
        validate(export("glb", 0.02, "company/school").resolve("swim.glb"));
    }

    private void validate(Path file) throws IOException, InterruptedException {
        Path validator = READERS.resolve("../../node_modules/gltf-validator").normalize();
        assumeThat(validator).as("installed by ./setup.sh --readers where npm is").isDirectory();
        Path log = folder.resolve("validator.log");

        int status = run(log.toFile(), "node", CHECK.resolveSibling("validate_glb.js").toString(), validator.toString(),
                file.toString());

        assertThat(status).as(Files.readString(log)).isZero();
    }

    /** That the comparison would find a difference. */
    @ParameterizedTest
    @CsvSource({"vtp", "ply", "usd", "csv", "npz"})
    void anotherSwimIsNotTheSame(String format) throws IOException, InterruptedException {
        Path stream = stream(0.05, "thesis/creature-1", "--precision", "double");
        Path export = export(format, 0.05, "thesis/creature-1");
        Path metadata = export.resolve("metadata.json");
        Files.writeString(metadata, Files.readString(metadata).replace("\"float\"", "\"double\""));

        assertThat(check(1, stream, export)).contains("; expected ").hasLineCount(1);
    }

    /** A motion that is twice as large as the memory is written all the same. */
    @Test
    void memoryDoesNotGrowWithTheDuration() throws IOException, InterruptedException {
        Path log = folder.resolve("log");
        int status = run(log.toFile(), JavaCommand.within(18, Main.class, "export", "thesis/tank", "--format", "npz", "--duration", "4",
                "--overrides", "{\"solver\":{\"substeps\":1}}", "--simulator-path", SIMULATOR.toString(), "--output-dir",
                folder.resolve("long").toString()).toArray(String[]::new));

        assertThat(status).as(Files.readString(log)).isZero();
        assertThat(Files.size(folder.resolve("long/swim.npz"))).isGreaterThan(2 * (18L << 20));
    }
}
