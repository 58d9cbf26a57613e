package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.config.Json;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.Socket;
import java.net.URI;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.net.http.HttpResponse.BodyHandlers;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** What is served, and to whom. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ViewServerTest {

    @TempDir
    private static Path folder;
    private static ViewServer server;
    private static Path run;

    @BeforeAll
    static void start() throws InterruptedException {
        run = ViewFixture.evolve(folder);
        server = ViewFixture.server(run);
    }

    @AfterAll
    static void stop() {
        server.close();
    }

    private static HttpResponse<String> get(String path) throws IOException, InterruptedException {
        return StreamClient.HTTP.send(HttpRequest.newBuilder(server.address().resolve(path)).build(),
                BodyHandlers.ofString());
    }

    private static JsonNode json(String path) throws IOException, InterruptedException {
        HttpResponse<String> answer = get(path);
        assertThat(answer.statusCode()).isEqualTo(200);
        assertThat(answer.headers().firstValue("Content-Type")).hasValue("application/json");
        return Json.parse(answer.body(), JsonNode.class);
    }

    /** The head of the answer to a request as it stands, which no client would send, and what comes with it. */
    private static String raw(String... lines) throws IOException {
        URI address = server.address();
        try (Socket socket = new Socket(address.getHost(), address.getPort())) {
            socket.setSoTimeout(1000 * ViewFixture.PATIENCE_SECONDS);
            socket.getOutputStream().write((String.join("\r\n", lines) + "\r\n\r\n")
                    .getBytes(StandardCharsets.ISO_8859_1));
            byte[] buffer = new byte[1 << 16];
            StringBuilder answer = new StringBuilder();
            int count = 0;
            while (count >= 0 && answer.indexOf("\r\n\r\n") < 0) {
                count = socket.getInputStream().read(buffer);
                answer.append(new String(buffer, 0, Math.max(count, 0), StandardCharsets.ISO_8859_1));
            }
            return answer.toString();
        }
    }

    @Test
    void thePageAndItsPartsMayLoadFromHereAlone() throws IOException, InterruptedException {
        HttpResponse<String> page = get("/");

        assertThat(page.body()).containsIgnoringCase("<!doctype html>");
        assertThat(page.headers().firstValue("Content-Type")).hasValue("text/html;charset=utf-8");
        assertThat(page.headers().firstValue("Content-Security-Policy").orElseThrow())
                .startsWith("default-src 'none'; script-src 'self' 'sha256-").contains("frame-ancestors 'none'")
                .doesNotContain("unsafe", "*", "https:");
        assertThat(page.headers().firstValue("X-Content-Type-Options")).hasValue("nosniff");
        assertThat(page.headers().map()).doesNotContainKey("access-control-allow-origin");
    }

    @ParameterizedTest
    @ValueSource(strings = {"/three/three.module.min.js", "/three/three.core.min.js",
            "/three/addons/controls/OrbitControls.js"})
    void threeIsServedFromItsWebJar(String path) throws IOException, InterruptedException {
        HttpResponse<String> file = get(path);

        assertThat(file.statusCode()).isEqualTo(200);
        assertThat(file.headers().firstValue("Content-Type")).hasValue("text/javascript;charset=utf-8");
        assertThat(file.body()).hasSizeGreaterThan(10_000);
    }

    @Test
    void theSetupTellsWhatThereIs() throws IOException, InterruptedException {
        JsonNode setup = json("/api/setup");

        assertThat(setup.get("version").textValue()).matches("\\d+\\.\\d+\\.\\d+.*");
        assertThat(setup.get("scenes")).extracting(JsonNode::textValue).contains("thesis/creature-1", "thesis/tank");
        assertThat(setup.get("schemes")).extracting(JsonNode::textValue)
                .containsExactly("flex", "conserving", "lattice");
        assertThat(setup.get("start").get("scene").textValue()).isEqualTo(ViewFixture.SCENE);
        assertThat(setup.get("start").get("gait").get("frequency").asDouble()).isEqualTo(1.5);
        assertThat(setup.get("runs").toString()).isEqualTo("[{\"id\":0,\"name\":\"my-run\"}]");
        assertThat(setup.get("gaits")).hasSize(1);
        assertThat(setup.get("gaits").get("thesis/creature-3").toString())
                .isEqualTo(Json.line(ViewFixture.KNOWN.get("thesis/creature-3")));
    }

    @Test
    void aRunIsTold() throws IOException, InterruptedException {
        JsonNode answer = json("/api/runs/0");

        assertThat(answer.get("name").textValue()).isEqualTo("my-run");
        assertThat(answer.get("scene").textValue()).isEqualTo("thesis/creature-1");
        assertThat(answer.get("overrides").get("scheme").textValue()).isEqualTo("conserving");
        assertThat(answer.get("optimizer").textValue()).isEqualTo("random");
        assertThat(answer.get("seed").asInt()).isEqualTo(5);
        assertThat(answer.get("generations")).hasSize(4);
        assertThat(answer.get("bests")).hasSize(4);
        assertThat(answer.get("verdict").get("text").textValue())
                .matches("(swims|does not swim|not judged|may swim).*");
        assertThat(answer.get("facts").fieldNames()).toIterable()
                .containsExactly("verdict", "speed", "distance", "half step", "selected", "cost", "flow");
        assertThat(answer.get("facts").get("cost").textValue()).startsWith("cost of transport 5.41 mass");
        assertThat(answer.get("map").isNull() && answer.get("front").isNull()).isTrue();
        double bestEver = Double.NEGATIVE_INFINITY;
        for (int i = 0; i < 4; i++) {
            JsonNode generation = answer.get("generations").get(i);
            bestEver = Math.max(bestEver, generation.get("best").asDouble());
            assertThat(generation.get("bestEver").asDouble()).isEqualTo(bestEver);
            assertThat(generation.get("mean").asDouble()).isLessThan(generation.get("best").asDouble());
            JsonNode best = answer.get("bests").get(i);
            assertThat(best.get("generation").asInt()).isEqualTo(generation.get("generation").asInt()).isEqualTo(i);
            assertThat(best.get("fitness")).isEqualTo(generation.get("best"));
            assertThat(Files.readAllLines(run.resolve("evaluations.jsonl")))
                    .filteredOn(line -> line.contains("\"gait\":" + best.get("gait"))
                            && line.contains(best.get("fitness").toString()))
                    .as("the gait of generation %d", i).isNotEmpty();
        }
        assertThat(answer.toString()).doesNotContain(folder.toString());
    }

    @Test
    void ofACompactRunTheBestIsKnown() throws IOException, InterruptedException {
        Files.move(run.resolve("evaluations.jsonl"), folder.resolve("away"));
        try {
            JsonNode answer = json("/api/runs/0");

            assertThat(answer.get("generations")).hasSize(4);
            JsonNode best = Json.parse(Files.readString(run.resolve("best.json")), JsonNode.class);
            assertThat(answer.get("bests")).isNotEmpty()
                    .allSatisfy(one -> assertThat(one.get("gait")).isEqualTo(best.get("gait")));
        } finally {
            Files.move(folder.resolve("away"), run.resolve("evaluations.jsonl"));
        }
    }

    @Test
    void aDamagedRunIsOneLine() throws IOException, InterruptedException {
        Path checkpoint = run.resolve("checkpoint.json");
        String whole = Files.readString(checkpoint);
        Files.writeString(checkpoint, "{");
        try {
            HttpResponse<String> answer = get("/api/runs/0");

            assertThat(answer.statusCode()).isEqualTo(500);
            assertThat(Json.parse(answer.body(), JsonNode.class).get("error").textValue()).contains("checkpoint")
                    .doesNotContain("\n");
        } finally {
            Files.writeString(checkpoint, whole);
        }
    }

    @ParameterizedTest
    @ValueSource(strings = {"/api/runs/1", "/api/runs/-1", "/api/runs/my-run", "/api/runs/0/best.json", "/api/runs/",
            "/api/runs/99999999999999999999", "/api/runs/..%2F..%2Fetc%2Fpasswd", "/api/runs/%2e%2e/%2e%2e/etc/passwd",
            "/app/../../../../logback-test.xml", "/app/%2e%2e/%2e%2e/%2e%2e/%2e%2e/logback-test.xml",
            "/app/..%2f..%2fRunAnswer.class",
            "/app/..\\..\\logback-test.xml", "/app/", "/app", "/app//etc/passwd", "/app/%00", "/three/../package.json",
            "/three/%2e%2e/package.json", "/three/addons/../../package.json", "/three/addons/", "/META-INF/MANIFEST.MF",
            "/io/natator/view/ViewServer.class", "/logback-test.xml"})
    void pathsLeadNowhereElse(String path) throws IOException {
        String answer = raw("GET " + path + " HTTP/1.1", "Host: localhost");

        assertThat(answer).containsPattern("^HTTP/1.1 40[04] ").doesNotContain("root:", "configuration", "\"name\"");
    }

    /** A long path once took all of the stack. */
    @ParameterizedTest
    @ValueSource(strings = {"/app/", "/three/", "/three/addons/"})
    void aLongPathIsNotFound(String folder) throws IOException {
        assertThat(raw("GET " + folder + "a/".repeat(3000) + "b.js HTTP/1.1", "Host: localhost"))
                .startsWith("HTTP/1.1 404 ");
    }

    @ParameterizedTest
    @CsvSource({"evil.example, 403", "evil.example:80, 403", "127.0.0.1.evil.example, 403",
            "localhost.evil.example, 403",
            "localhost; script-src *, 40[03]", "'', 40[03]", "localhost:1, 200", "127.0.0.1, 200", "[::1]:8080, 200"})
    void aForeignHostIsRefused(String host, String status) throws IOException {
        assertThat(raw("GET /api/setup HTTP/1.1", "Host: " + host)).containsPattern("^HTTP/1.1 " + status + " ");
    }

    @ParameterizedTest
    @CsvSource(nullValues = "-",
            value = {"localhost, http://evil.example, 403", "localhost, -, 403", "localhost, null, 403",
                    "evil.example, http://evil.example, 403", "localhost, http://localhost:81, 403",
                    "localhost:81, http://localhost:81, 101", "127.0.0.1, http://127.0.0.1, 101"})
    void aForeignOriginGetsNoSocket(String host, String origin, String status) throws IOException {
        String answer = raw("GET /stream HTTP/1.1", "Host: " + host, "Upgrade: websocket",
                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==", "Sec-WebSocket-Version: 13",
                "Sec-WebSocket-Extensions: permessage-deflate", origin == null ? "X: y" : "Origin: " + origin,
                "Connection: Upgrade");

        assertThat(answer).startsWith("HTTP/1.1 " + status + " ").doesNotContain("Sec-WebSocket-Extensions");
    }

    @Test
    void otherMethodsAreNotServed() throws IOException {
        assertThat(raw("POST /api/setup HTTP/1.1", "Host: localhost", "Content-Length: 0")).startsWith("HTTP/1.1 404 ");
        assertThat(raw("DELETE /api/runs/0 HTTP/1.1", "Host: localhost")).startsWith("HTTP/1.1 404 ");
        assertThat(run).exists();
    }

    @Test
    void aPortThatIsTakenIsNamed() {
        ViewSettings same = new ViewSettings(ViewFixture.SIMULATOR, ViewSettings.LOOPBACK, server.address().getPort(),
                new InitialScene(ViewFixture.SCENE, null, null), scene -> null, List.of(), null);

        assertThatThrownBy(() -> new ViewServer(same).close()).isInstanceOf(UncheckedIOException.class)
                .hasMessage("cannot listen at port " + server.address().getPort()
                        + " of 127.0.0.1; choose another by --port, or any that is free by --port 0");
    }

    @Test
    void whatIsNoRunIsNamed() {
        assertThatThrownBy(() -> ViewFixture.server(folder.resolve("nothing")).close())
                .isInstanceOf(InvalidInputException.class)
                .hasMessage(folder.resolve("nothing") + " is not a run folder: it has no config.json");
    }
}
