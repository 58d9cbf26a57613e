package io.natator.view;

import static io.natator.view.ViewFixture.GAIT;
import static io.natator.view.ViewFixture.SCENE;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.process.Processes;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** What goes on at a page's socket, with the real simulator behind it. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class StreamSocketTest {

    private static ViewServer server;
    private final List<StreamClient> clients = new ArrayList<>();

    @BeforeAll
    static void start() throws InterruptedException {
        server = ViewFixture.server();
    }

    @AfterAll
    static void stop() {
        server.close();
    }

    /** A page that goes takes its simulator along. */
    @AfterEach
    void nothingRunsOn() throws InterruptedException {
        clients.forEach(StreamClient::close);
        Processes.await("end of all simulators",
                () -> ViewFixture.simulators(ProcessHandle.current()).isEmpty());
        Processes.await("end of all sessions", () -> server.sessions().isEmpty());
        Processes.assertThatNoChildIsLeft();
    }

    private StreamClient open() {
        clients.add(StreamClient.open(server.address()));
        return clients.get(clients.size() - 1);
    }

    private StreamClient openStarted(boolean paused) throws InterruptedException {
        StreamClient page = open().start(SCENE, GAIT, paused);
        assertThat(page.await("SCEN").get("scene").textValue()).isEqualTo(SCENE);
        return page;
    }

    private static long number(ByteBuffer frame) {
        return Integer.toUnsignedLong(frame.getInt(4));
    }

    @Test
    void framesComeAsTheSimulatorWroteThem() throws InterruptedException {
        StreamClient page = open().start(SCENE, GAIT, true);
        JsonNode scene = page.await("SCEN");

        page.send("{'do':'credit','frames':3,'id':7}");
        assertThat(page.await("ANSW").toString()).isEqualTo("{\"id\":7,\"ok\":true}");
        page.send("{'do':'step','frames':2}").send("{'do':'step','frames':1}");

        assertThat(scene.get("gait").get("frequency").asDouble()).isEqualTo(1.5);
        assertThat(scene.get("restarted").asBoolean()).isTrue();
        int size = 72 + 4 * scene.get("actuators").asInt() + 28 * scene.get("particles").asInt();
        ByteBuffer frame = page.awaitFrame();
        while (number(frame) < 2) {
            frame = page.awaitFrame();
        }
        assertThat(frame.remaining()).isEqualTo(size);
        assertThat(frame.getInt(0)).isEqualTo(scene.get("number").asInt());
        assertThat(frame.getDouble(16)).isCloseTo(2 * scene.get("timeStep").asDouble(), within(1e-9));
        assertThat(number(page.awaitFrame())).isEqualTo(3);
    }

    /** With its head: what begins otherwise is a frame. */
    @Test
    void waterComesWithItsHead() throws InterruptedException {
        StreamClient page = open().start("plane/loach", "null", true);
        int number = page.await("SCEN").get("number").asInt();

        page.send("{'do':'water','id':5}");

        assertThat(page.await("ANSW").toString()).isEqualTo("{\"id\":5,\"ok\":true}");
        ByteBuffer water = page.awaitFrame();
        int size = 64 + 16 * 160 * 80;
        assertThat(StandardCharsets.US_ASCII.decode(water.duplicate().limit(4)).toString()).isEqualTo("WATR");
        assertThat(water.remaining()).isEqualTo(8 + size);
        assertThat(List.of(water.getInt(4), water.getInt(8), water.getInt(16), water.getInt(20), water.getInt(24)))
                .containsExactly(size, number, 160, 1, 80);
    }

    @Test
    void noMoreFramesComeThanWereGranted() throws InterruptedException {
        StreamClient page = openStarted(true);

        page.send("{'do':'credit','frames':1}").send("{'do':'step','frames':5,'id':1}").send("{'do':'step','id':2}");
        while (page.await("ANSW").path("id").asInt() != 2) {
            // Those of the commands before.
        }
        page.awaitFrame();
        for (int i = 3; i < 8; i++) {
            page.send("{'do':'step','frames':1,'id':" + i + "}");
            assertThat(page.await("ANSW").get("ok").asBoolean()).isTrue();
        }

        assertThat(page.waitingFrames()).isZero();
        page.send("{'do':'credit','frames':1}").send("{'do':'step','frames':1}");
        ByteBuffer frame = page.awaitFrame();
        assertThat(Integer.toUnsignedLong(frame.getInt(8))).as("dropped and counted").isPositive();
        assertThat(page.waitingFrames()).isZero();
    }

    /** A thousand frames are over a hundred megabytes: they wait in the simulator, which stands still meanwhile. */
    @Test
    void aPageThatTakesNothingCostsNoMemory() throws InterruptedException {
        StreamClient page = StreamClient.openSlow(server.address());
        clients.add(page);
        long before = usedMemory();

        page.start("thesis/creature-1", GAIT, false).send("{'do':'rate','value':0}")
                .send("{'do':'credit','frames':1000}");
        Processes.await("start", () -> ViewFixture.simulators(ProcessHandle.current()).size() == 1);
        ProcessHandle simulator = ViewFixture.simulator();
        Duration[] last = {Duration.ZERO};
        long[] since = {System.nanoTime()};
        Processes.await("the simulator to stand still", () -> {
            Duration now = simulator.info().totalCpuDuration().orElseThrow(() -> new AssertionError("it has ended"));
            if (!now.equals(last[0])) {
                last[0] = now;
                since[0] = System.nanoTime();
            }
            return now.toMillis() > 10 && System.nanoTime() - since[0] > 1_500_000_000L;
        });

        assertThat(usedMemory() - before).as("bytes more in use").isLessThan(30_000_000);
        page.wake();
        long sent = 0;
        for (int i = 0; i < 300; i++) {
            sent += page.awaitFrame().remaining();
        }
        assertThat(sent).isGreaterThan(45_000_000);
    }

    /** One that is stopped, as in a debugger, keeps its simulation: Jetty's own limit is 30 s. */
    @Test
    void aPageMayTakeNothingForAnyTime() throws InterruptedException {
        openStarted(true);

        assertThat(server.sessions()).singleElement()
                .satisfies(session -> assertThat(session.socket.getIdleTimeout()).isZero());
    }

    /** Names of so many parts once took all of the stack, and the socket with it. */
    @ParameterizedTest
    @ValueSource(strings = {"a/", "a-b/", "a."})
    void aLongNameIsAnsweredAndCostsNothing(String part) throws InterruptedException {
        StreamClient page = openStarted(true);

        page.send("{'do':'scene','scene':'" + part.repeat(60_000 / part.length()) + "a.json','id':4}");

        JsonNode answer = page.await("ANSW");
        assertThat(answer.get("error").textValue()).contains("expected a named scene");
        assertThat(answer.get("id").intValue()).isEqualTo(4);
        page.send("{'do':'pause','id':5}");
        assertThat(page.await("ANSW").toString()).isEqualTo("{\"id\":5,\"ok\":true}");
    }

    private static long usedMemory() {
        Runtime runtime = Runtime.getRuntime();
        System.gc();
        return runtime.totalMemory() - runtime.freeMemory();
    }

    @Test
    void aSettingIsAnsweredInShort() throws InterruptedException {
        StreamClient page = openStarted(true);

        page.send("{'do':'overrides','overrides':{'solver':{'damping':2}}}");

        JsonNode change = page.await("SCEN");
        assertThat(change.get("restarted").booleanValue()).isFalse();
        assertThat(change.get("definition").get("solver").get("damping").asInt()).isEqualTo(2);
        assertThat(change.has("mass")).isFalse();
        assertThat(change.toString().length()).isLessThan(4000);
    }

    @Test
    void aKilledSimulatorIsReplaced() throws InterruptedException {
        StreamClient page = openStarted(false);
        page.send("{'do':'overrides','overrides':{'solver':{'gravity':[0,-0.5,0]}},'id':1}");
        JsonNode before = page.await("SCEN");
        assertThat(before.get("overrides").toString()).contains("-0.5");
        page.send("{'do':'credit','frames':1000}");
        page.awaitFrame();

        ProcessHandle first = ViewFixture.simulator();
        first.destroyForcibly();

        JsonNode lost = page.await("LOST");
        assertThat(lost.get("restarted").asBoolean()).isTrue();
        assertThat(lost.get("reason").textValue()).contains("exit status 137");
        JsonNode scene = page.await("SCEN");
        assertThat(scene.get("overrides").toString()).contains("-0.5");
        assertThat(scene.get("gait").get("frequency").asDouble()).isEqualTo(1.5);
        assertThat(scene.get("number")).as("it begins anew").isNotEqualTo(before.get("number"));
        page.send("{'do':'credit','frames':2}");
        ByteBuffer frame = page.awaitFrame();
        while (frame.getInt(0) != scene.get("number").intValue()) {
            frame = page.awaitFrame();
        }
        assertThat(number(page.awaitFrame())).as("it goes on").isGreaterThan(number(frame));
        page.send("{'do':'step','id':2}");
        while (page.await("ANSW").path("id").asInt() != 2) {
            // Those of the commands before.
        }
        assertThat(page.waitingFrames()).as("the credit of before is gone").isZero();
        assertThat(ViewFixture.simulator().pid()).isNotEqualTo(first.pid());
    }

    @Test
    void aSimulatorThatDiesTooOftenIsLeftAlone() throws InterruptedException {
        StreamClient page = openStarted(true);
        for (int i = 1; i <= 4; i++) {
            ViewFixture.simulator().destroyForcibly();
            assertThat(page.await("LOST").get("restarted").asBoolean()).as("after %d deaths", i).isEqualTo(i < 4);
            if (i < 4) {
                page.await("SCEN");
            }
        }
        page.send("{'do':'run','id':9}");
        assertThat(page.await("ANSW").toString()).contains("\"id\":9", "no simulation runs");

        page.start(SCENE, GAIT, true);
        assertThat(page.await("SCEN").get("restarted").asBoolean()).isTrue();
    }

    @Test
    void aPausedSimulatorIsReplacedByAPausedOne() throws InterruptedException {
        StreamClient page = openStarted(false);
        page.send("{'do':'pause'}").send("{'do':'credit','frames':5,'id':1}");
        page.await("ANSW");
        ViewFixture.simulator().destroyForcibly();
        page.await("LOST");
        page.await("SCEN");

        page.send("{'do':'credit','frames':2}").send("{'do':'step','frames':1,'id':2}");
        ByteBuffer frame = page.awaitFrame();
        while (number(frame) != 1) {
            frame = page.awaitFrame();
        }
        assertThat(frame.getInt(12) & 1).as("running").isZero();
    }

    @Test
    void theFifthSimulationIsRefused() throws InterruptedException {
        for (int i = 0; i < 4; i++) {
            openStarted(true);
        }

        assertThat(open().awaitClose()).isEqualTo("1013 4 simulations run already; close a page");
        assertThat(ViewFixture.simulators(ProcessHandle.current())).hasSize(4);

        clients.get(0).close();
        Processes.await("the end of one", () -> ViewFixture.simulators(ProcessHandle.current()).size() == 3);
        openStarted(true);
    }

    @Test
    void aMessageThatIsTooLongClosesTheSocket() throws InterruptedException {
        StreamClient page = openStarted(true);
        page.send("{'do':'pause','id':1,'x':'" + "y".repeat(60_000) + "'}");
        page.await("ANSW");

        page.send("{'do':'pause','id':2,'x':'" + "y".repeat(70_000) + "'}");

        assertThat(page.awaitClose()).startsWith("1009 ");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "{|command: ",
            "[]|command: expected an object with a text \"do\"",
            "{'do':7}|command: expected an object with a text \"do\"",
            "{'do':'run','do':'pause'}|command: Duplicate field 'do'",
            "{'do':'run'}|run: no simulation runs; expected start",
            "{'do':'start'}|scene: expected a named scene",
            "{'do':'start','scene':'thesis/tank','gait':'/etc/passwd'}|gait: expected an object",
            "{'do':'start','scene':'thesis/tank','overrides':'x.json'}|overrides: expected an object",
            "{'do':'scene','scene':'/etc/hosts.json'}|scene: expected a named scene",
            "{'do':'overrides','overrides':{'creature':{'name':'/etc/hosts.json'}}}|overrides.creature.name: expected"})
    void aCommandThatIsNoneIsAnswered(String command, String error) throws InterruptedException {
        JsonNode answer = open().send(command).await("ANSW");

        assertThat(answer.get("error").textValue()).contains(error).doesNotContain("\n", "Exception");
        assertThat(answer.has("id")).isTrue();
    }

    @Test
    void whatTheSimulatorRefusesAtTheStartIsTold() throws InterruptedException {
        StreamClient page = open().start("thesis/no-such", GAIT, true);
        JsonNode lost = page.await("LOST");

        assertThat(lost.get("restarted").asBoolean()).isFalse();
        assertThat(lost.get("reason").textValue()).contains("unknown scene \"thesis/no-such\"");
        page.start(SCENE, GAIT, true);
        page.await("SCEN");
        assertThat(page.start(SCENE, GAIT, true).await("ANSW").get("error").textValue()).contains("expected scene");
    }

    @Test
    void binaryMessagesAreRefused() throws InterruptedException {
        StreamClient page = openStarted(true);
        page.sendBinary();

        assertThat(page.awaitClose()).isEqualTo("1003 expected text");
    }

    /** Whatever a page sends is answered, and leaves its simulation as it was. */
    @Test
    void noCommandCostsThePageItsSimulation() throws InterruptedException {
        StreamClient page = openStarted(true);
        List<String> hostile = new ArrayList<>(
                List.of("", "x", "3", "null", "[]", "{}", "{\"do\":3}", "{\"do\":null}", "{\"do\":\"\"}",
                        "{\"do\":\"none\"}", "{\"do\":\"start\"}", "{\"do\":\"start\",\"scene\":3}",
                        "{\"do\":\"scene\"}", "{\"do\":\"scene\",\"scene\":[]}",
                        "{\"do\":\"scene\",\"scene\":\"--help\"}", "{\"do\":\"scene\",\"scene\":\"a\\u0000.json\"}",
                        "{\"do\":\"step\",\"frames\":1e999}",
                        "{\"do\":\"step\",\"frames\":-1}", "{\"do\":\"rate\"}", "{\"do\":\"rate\",\"value\":\"x\"}",
                        "{\"do\":\"gait\",\"gait\":3}",
                        "{\"do\":\"gait\",\"gait\":{}}", "{\"do\":\"overrides\",\"overrides\":[]}",
                        "{\"do\":\"overrides\",\"overrides\":{\"base\":\"\\u0000.json\"}}",
                        "{\"do\":\"overrides\",\"overrides\":{\"creature\":{\"mesh\":{\"file\":\"\\u0000\"}}}}",
                        "{\"do\":\"none\",\"do\":\"run\"}",
                        "{\"do\":\"none\",\"id\":{\"a\":[]}}", "{\"do\":\"none\",\"id\":\"x\"}",
                        "{\"do\":\"none\",\"id\":1.5}", "{\"do\":\"none\",\"id\":-1}",
                        "{\"do\":\"none\",\"id\":true}", "{\"do\":\"\\ud800\"}", "{\"do\":\"drive\",\"drive\":[\"x\"]}",
                        "{\"do\":\"sense\",\"flow\":3}",
                        "{\"do\":\"none\"", "{\"do\":\"none\"} {\"do\":\"none\"}", "\u0000", "{\"do\":\"a\\nb\"}"));
        for (int depth : new int[] {900, 999, 1000, 20000}) {
            hostile.add("{\"do\":\"none\",\"id\":" + "[".repeat(depth) + "]".repeat(depth) + "}");
            hostile.add("{\"do\":\"overrides\",\"overrides\":" + "{\"a\":".repeat(depth / 2) + "1"
                    + "}".repeat(depth / 2) + "}");
            hostile.add("{\"do\":\"none\",\"id\":" + "9".repeat(depth) + "}");
        }
        for (String command : hostile) {
            page.send(command);
            JsonNode answer = page.await("ANSW");
            assertThat(answer.path("error").asText()).as(command).isNotEmpty().doesNotContain("internal error", "\n");
        }
        page.send("{'do':'step','id':7}");
        assertThat(page.await("ANSW").toString()).isEqualTo("{\"id\":7,\"ok\":true}");
    }
}
