package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.JavaCommand;
import io.natator.config.Json;
import io.natator.process.FakeSimulator;
import io.natator.view.StreamClient;
import java.io.BufferedReader;
import java.io.IOException;
import java.net.ServerSocket;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse.BodyHandlers;
import java.nio.ByteBuffer;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** {@code natator view} from the command line to its end; the simulator is the real one. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ViewCommandTest extends CommandTest {

    private Process program;

    @AfterEach
    void end() {
        if (program != null) {
            program.destroyForcibly();
        }
    }

    /** Starts the program and reads the address that it prints. */
    private URI start(String... arguments) throws IOException {
        return startAt("127\\.0\\.0\\.1", arguments);
    }

    private URI startAt(String host, String... arguments) throws IOException {
        List<String> command = JavaCommand.of(Main.class, "view", "--simulator-path", SIMULATOR.toString(), "--port",
                "0", "--no-browser");
        command.addAll(List.of(arguments));
        program = new ProcessBuilder(command).redirectError(folder.resolve("errors").toFile()).start();
        BufferedReader out = program.inputReader();
        String address = out.readLine();
        assertThat(address).as(Files.readString(folder.resolve("errors"))).matches("http://" + host + ":\\d+/");
        return URI.create(address);
    }

    /** Evolves a scene's creature for three generations of eight, with another scheme than the scene's and no real simulator. */
    private Path evolve(String scene) {
        ok(with(FakeSimulator.in(folder),
                "evolve --no-cache --population 8 --generations 3 --seed 5 --optimizer random "
                        + "--scheme conserving --scene",
                scene, "--output-dir", path("run")));
        return folder.resolve("run");
    }

    private static JsonNode start(URI server) throws IOException, InterruptedException {
        return setup(server).get("start");
    }

    private static JsonNode setup(URI server) throws IOException, InterruptedException {
        return Json.parse(HttpClient.newHttpClient().send(
                HttpRequest.newBuilder(server.resolve("/api/setup")).build(), BodyHandlers.ofString()).body(),
                JsonNode.class);
    }

    /** As by Ctrl-C or by the system's end. */
    @Test
    void whenToldToEndItLeavesNothingBehind() throws IOException, InterruptedException {
        URI server = start("--creature", "1");
        for (int i = 0; i < 2; i++) {
            watch(server, "thesis/creature-1");
        }
        List<ProcessHandle> simulators = program.descendants().toList();
        assertThat(simulators).hasSize(2);

        program.destroy();

        assertThat(program.waitFor(5, TimeUnit.MINUTES)).as("it ends in time").isTrue();
        assertThat(program.exitValue()).isEqualTo(128 + 15);
        for (ProcessHandle simulator : simulators) {
            simulator.onExit().orTimeout(5, TimeUnit.MINUTES).join();
        }
        assertThat(Files.readString(folder.resolve("errors"))).isEmpty();
    }

    /** A scene that the page has saved; no other file may be named. */
    @Test
    void aSceneFileIsShown() throws IOException, InterruptedException {
        Path scene = Files.writeString(folder.resolve("mine.json"),
                "{\"base\":\"thesis/creature-1-vacuum\",\"scheme\":\"conserving\"}");
        Path other = Files.copy(scene, folder.resolve("other.json"));
        URI server = start("--scene", scene.toString());

        String named = start(server).get("scene").textValue();

        assertThat(named).isEqualTo(scene.toString());
        assertThat(watch(server, named)).startsWith("{\"type\":\"SCEN\"").contains("\"scheme\":\"conserving\"");
        assertThat(watch(server, other.toString())).startsWith("{\"type\":\"ANSW\"")
                .contains("expected a named scene or one that the server was started with");
    }

    /** A network without weights, which stops the beat and bends; in no scene but its own. */
    @Test
    void aPolicySwimsInItsScene() throws IOException, InterruptedException {
        Path policy = policy(15);
        URI server = start("--policy", policy.toString());

        JsonNode shown = start(server);

        assertThat(shown.get("scene").textValue()).isEqualTo("bench/small-tank");
        assertThat(shown.get("overrides").toString()).isEqualTo("{\"solver\":{\"substeps\":3}}");
        assertThat(watch(server, "bench/small-tank")).startsWith("{\"type\":\"SCEN\"").contains("\"frequency\":1.25");
        assertThat(driven(server, "bench/small-tank")).containsExactly(0.25f, -0.25f);
        assertThat(watch(server, "thesis/creature-1")).startsWith("{\"type\":\"SCEN\"").doesNotContain("1.25");
    }

    /** How the two actuators are driven after six frames. */
    private static List<Float> driven(URI server, String scene) throws InterruptedException {
        try (StreamClient page = started(server, scene).send("{'do':'credit','frames':100}")) {
            ByteBuffer frame = page.awaitFrame();
            while (frame.getInt(4) != 6) {
                frame = page.awaitFrame();
            }
            return List.of(frame.getFloat(72), frame.getFloat(76));
        }
    }

    /** With so many inputs, for two actuators. */
    private Path policy(int inputs) throws IOException {
        String rows = String.join(",", Collections.nCopies(inputs, "[0,0,0,0]"));
        return Files.writeString(folder.resolve("policy.json"),
                "{\"environment\":{\"scene\":\"bench/small-tank\",\"overrides\":{\"solver\":{\"substeps\":3}},\"actions\":\"gait\","
                        + "\"gait\":{\"frequency\":1.25,\"amplitude\":[0.5,0.5],\"phase\":[0,0.5]},\"frames\":3,\"flow\":[],"
                        + "\"target\":null},\"layers\":[{\"weights\":[" + rows + "],\"bias\":[-1,-1,0.5,-0.5]}]}");
    }

    @Test
    void aPolicyOfAnotherBodyIsRefused() throws IOException {
        for (String command : List.of("view --no-browser --port 0",
                "page bench/small-tank --duration 0.1 --output " + folder.resolve("page.html"))) {
            refused(natator(command + " --policy", policy(14).toString()))
                    .isEqualTo("natator " + command.split(" ")[0]
                            + ": natator-sim: --policy: has 14 inputs and 4 outputs; "
                            + "must have 15 and 4 for this body\n");
        }
        Path none = Files.writeString(folder.resolve("none.json"), "{\"layers\":[]}");
        refused(natator("view --no-browser --port 0 --policy", none.toString()))
                .isEqualTo("natator view: --policy: " + none
                        + ": must have an environment with the scene that it was learned in\n");
        refused(natator("view --no-browser --port 0 --creature 1 --policy", policy(15).toString()))
                .isEqualTo(
                        "natator view: --policy has its own scene and gait; expected no --scene, --creature or --gait\n");
    }

    private static StreamClient started(URI server, String scene) {
        return StreamClient.open(server).send("{'do':'start','scene':'" + scene + "'}");
    }

    /** Opens a socket and starts a scene; what it says first. */
    private static String watch(URI server, String scene) throws InterruptedException {
        return started(server, scene).next().toString();
    }

    @Test
    void aThesisCreatureSwimsAsPublished() throws IOException, InterruptedException {
        JsonNode start = start(
                start("--creature", "2", "--overrides", "{\"solver\":{\"substeps\":2}}", "--scheme", "conserving"));

        assertThat(start.get("scene").textValue()).isEqualTo("thesis/creature-2");
        assertThat(start.get("overrides").toString())
                .isEqualTo("{\"solver\":{\"substeps\":2},\"scheme\":\"conserving\"}");
        assertThat(start.get("gait").get("frequency").asDouble()).isEqualTo(1.338);
        assertThat(start.get("gait").get("phase").get(1).asDouble()).isEqualTo(0.862);
    }

    /** What the thesis published is for its creature alone. */
    @Test
    void anotherCreatureRests() throws IOException, InterruptedException {
        JsonNode start = start(start("--creature", "1", "--overrides", "{\"creature\":{\"name\":\"creature-2\"}}"));

        assertThat(start.path("gait").isObject()).isFalse();
    }

    @Test
    void aRunsSceneCanBeChangedToo() throws IOException, InterruptedException {
        Path run = evolve("thesis/creature-1");

        JsonNode start = start(start("--run", run.toString(), "--overrides", "{\"solver\":{\"substeps\":2}}"));

        assertThat(start.get("overrides").toString())
                .isEqualTo("{\"solver\":{\"substeps\":2},\"scheme\":\"conserving\"}");
    }

    /** Also where its scene is named; beside another scene it is only there to be looked at. */
    @ParameterizedTest
    @CsvSource({"'', true", "--creature 1, true", "--creature 2, false"})
    void ofARunTheBestSwims(String named, boolean isIts) throws IOException, InterruptedException {
        Path run = evolve("thesis/creature-1");

        JsonNode start = start(start(("--run " + run + " " + named).split(" ")));

        JsonNode best = Json.parse(Files.readString(run.resolve("best.json")), JsonNode.class).get("gait");
        assertThat(start.get("scene").textValue()).isEqualTo("thesis/creature-" + (isIts ? 1 : 2));
        assertThat(start.get("gait").equals(best)).isEqualTo(isIts);
        assertThat(start.get("overrides").toString()).isEqualTo(isIts ? "{\"scheme\":\"conserving\"}" : "null");
    }

    /** As {@code evolve} has a creature without more options: in another scene than where it is shown without a run. */
    @Test
    void ofARunOfTheNumberedCreatureTheBestSwimsWhereItWasFound() throws IOException, InterruptedException {
        Path run = evolve("pool/creature-1");

        JsonNode start = start(start("--creature", "1", "--run", run.toString()));

        JsonNode best = Json.parse(Files.readString(run.resolve("best.json")), JsonNode.class).get("gait");
        assertThat(start.get("scene").textValue()).isEqualTo("pool/creature-1");
        assertThat(start.get("gait")).isEqualTo(best);
    }

    @Test
    void whoOpensItToOthersIsWarned() throws IOException {
        startAt("[^/]+", "--creature", "1", "--host", "0.0.0.0");

        assertThat(Files.readString(folder.resolve("errors")))
                .isEqualTo("warning: --host 0.0.0.0: whoever can reach this "
                        + "address can watch, and start up to 4 simulations on this machine; nobody is asked who they are\n");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {"[5,0.5]|[0,0.5]|amplitude[0] = 5: must be a number in [0, 2]",
            "[0.5]|[0]|amplitude has length 1: must have length 2, one value per actuator of the creature"})
    void aGaitThatTheSimulatorRefusesIsRefused(String amplitude, String phase, String message) throws IOException {
        Path gait = Files.writeString(folder.resolve("gait.json"),
                "{\"frequency\":1,\"amplitude\":" + amplitude + ",\"phase\":" + phase + "}");
        for (String command : List.of("view --no-browser --port 0 --scene",
                "page --output " + folder.resolve("page.html"))) {
            refused(natator(command, "thesis/creature-1", "--gait", gait.toString()))
                    .isEqualTo("natator " + command.split(" ")[0] + ": natator-sim: gait." + message + "\n");
        }
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "--port 70000|2|natator view: --port is 70000; expected a whole number from 0 to 65535",
            "--creature 5|2|natator view: --creature is 5; expected 1, 2, 3 or 4",
            "--scene no/such|2|natator view: unknown scene \"no/such\"",
            "--scene no/such.json|2|natator view: --scene is no/such.json; expected a named scene or an existing file",
            "--gait no-such.json|2|natator view: --gait no-such.json does not exist",
            "--run no/such --run ./no/such|2|natator view: --run has ./no/such twice; expected each once",
            "--run no/such|2|natator view: no/such is not a run folder: it has no config.json",
            "--host no-such-host.invalid|2|natator view: --host is no-such-host.invalid, an unknown name; expected a name or "
                    + "address of this machine",
            "--host 192.0.2.1|2|natator view: --host is 192.0.2.1; expected a name or address of this machine",
            "--overrides {\"solver\":{\"substep\":1}}|2|natator view: scene \"thesis/creature-1\": solver.substep: unknown key ",
            "--port TAKEN|1|natator view: cannot listen at port "})
    void whatIsWrongIsOneLine(String arguments, int status, String message) throws IOException {
        try (ServerSocket taken = new ServerSocket(0)) {
            List<String> all = new ArrayList<>(List.of("view", "--no-browser"));
            all.addAll(List.of(arguments.replace("TAKEN", "" + taken.getLocalPort()).split(" ")));
            if (!arguments.startsWith("--port")) {
                all.addAll(List.of("--port", "0"));
            }
            assertThat(natator(all)).as(err.toString()).isEqualTo(status);
        }
        assertThat(err.toString()).startsWith(message);
        assertThat(err.toString().lines()).hasSize(1);
    }
}
