package io.natator.replay;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.InvalidInputException;
import io.natator.config.Json;
import io.natator.stream.StreamBytes;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Base64;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.zip.InflaterInputStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The file that replays swims: what is in it, how exact and how large it is. */
class ReplayHtmlTest {

    private static final int OTHERS = 4;
    private static final Pattern SWIM = Pattern
            .compile("<script type=\"text/plain\" class=\"swim\"[^>]*>([^<]*)</script>");
    private static final Pattern MODULES = Pattern
            .compile("<script type=\"text/plain\" id=\"modules\"[^>]*>([^<]*)</script>");

    @TempDir
    private Path folder;

    /** Water that hops about at random, which nothing compresses, and a body. */
    private static Replay swim(String title, int water, int frames) {
        ObjectNode json = StreamBytes.scene();
        int particles = water + OTHERS;
        json.put("particles", particles).putArray("fluid").add(0).add(water);
        ArrayNode mass = json.putArray("mass");
        for (int i = 0; i < particles; i++) {
            mass.add(1);
        }
        for (String key : List.of("body", "slices", "clusters", "muscles")) {
            json.putArray(key);
        }
        for (int i = 0; i < OTHERS; i++) {
            json.withArray("body").add(water + i);
        }
        Random random = new Random(1);
        List<StreamFrame> all = new ArrayList<>();
        for (int frame = 0; frame < frames; frame++) {
            float[] position = new float[3 * particles];
            float[] density = new float[particles];
            for (int i = 0; i < position.length; i++) {
                position[i] = 4 * random.nextFloat();
            }
            for (int i = 0; i < water; i++) {
                density[i] = random.nextFloat();
            }
            all.add(new StreamFrame(frame, 0.0125 * frame, 0.1 * frame, new float[] {1, 2, 3}, 4, 5, 6, 7,
                    new float[] {0.5f}, position, density));
        }
        try {
            return new Replay(title, Json.parse(json.toString(), StreamScene.class), json.toString(), all,
                    List.of(), Map.of());
        } catch (JsonProcessingException e) {
            throw new IllegalStateException(e);
        }
    }

    private static byte[] inflated(String base64) throws IOException {
        return new InflaterInputStream(new ByteArrayInputStream(Base64.getDecoder().decode(base64))).readAllBytes();
    }

    private static List<String> found(Pattern pattern, String text) {
        Matcher matcher = pattern.matcher(text);
        List<String> all = new ArrayList<>();
        while (matcher.find()) {
            all.add(matcher.group(1));
        }
        return all;
    }

    /** What the user calls a page is text, also if it looks like a place of ours. */
    @Test
    void aTitleStaysAsItIs() throws IOException {
        Path file = folder.resolve("page.html");
        new ReplayHtml("{{swims}} $1 \\ {{modules}}", List.of(swim("{{style}}", 10, 4)), true).write(file, 10_000_000);

        String html = Files.readString(file);
        assertThat(html).contains("<title>{{swims}} $1 \\ {{modules}}</title>", "data-title=\"{{style}}\"");
        assertThat(SWIM.matcher(html).results()).hasSize(1);
        assertThat(MODULES.matcher(html).results()).hasSize(1);
    }

    @Test
    void thePageLoadsNothing() throws IOException {
        Path file = folder.resolve("swim.html");

        new ReplayHtml("Two <swims> & more", List.of(swim("\"first\"", 20, 5), swim("second", 20, 5)), true)
                .write(file, 1_000_000);

        String html = Files.readString(file);
        assertThat(html).contains("<title>Two &lt;swims> &amp; more</title>")
                .contains("data-title=\"&quot;first&quot;\"")
                .contains("content=\"default-src 'none';").doesNotContain("{{");
        assertThat(found(SWIM, html)).hasSize(2);
        String loading = html.replaceAll("<script type=\"text/plain\"[^>]*>[^<]*</script>", "");
        assertThat(loading).doesNotContainPattern("https?://").doesNotContainPattern("\\ssrc=")
                .doesNotContain("@import").doesNotContain("url(").doesNotContain("fetch(");
        assertThat(found(Pattern.compile("href=\"([^\"]*)\""), loading))
                .allSatisfy(link -> assertThat(link).startsWith("data:"));
    }

    @Test
    void allThatItsModulesImportIsInIt() throws IOException {
        Path file = folder.resolve("swim.html");
        new ReplayHtml("page", List.of(swim("swim", 20, 5)), true).write(file, 1_000_000);

        JsonNode modules = Json.parse(new String(inflated(found(MODULES, Files.readString(file)).get(0)),
                StandardCharsets.UTF_8), JsonNode.class);

        List<String> names = new ArrayList<>();
        modules.fieldNames().forEachRemaining(names::add);
        assertThat(names).contains("natator/replay.js", "natator/stage.js", "three", "three/three.core.min.js",
                "three/addons/controls/OrbitControls.js").doesNotContain("natator/main.js", "natator/connection.js");
        Pattern imports = Pattern.compile("\\bfrom\\s*[\"']([^\"']+)[\"']");
        modules.forEach(text -> assertThat(names).containsAll(found(imports, text.asText())));
    }

    @Test
    void framesAreLeftOutUntilThePageFits() throws IOException {
        List<Replay> swims = List.of(swim("swim", 400, 100));
        Path file = folder.resolve("swim.html");

        ReplayHtml.Written all = new ReplayHtml("page", swims, true).write(file, 10_000_000);
        ReplayHtml.Written some = new ReplayHtml("page", swims, true).write(file, all.bytes() - 1);

        assertThat(all.framesPerSecond()).isEqualTo(80);
        assertThat(all.isReduced()).isFalse();
        assertThat(all.largestError()).isBetween(3.0e-5, 3.1e-5);
        assertThat(some.framesPerSecond()).isEqualTo(40);
        assertThat(some.isReduced()).isTrue();
        assertThat(some.bytes()).isEqualTo(Files.size(file)).isLessThan(all.bytes());
        assertThat(folder).isDirectoryContaining(one -> one.equals(file)).isDirectoryNotContaining("glob:**.new");
    }

    @ParameterizedTest
    @CsvSource({"100000, 0.1 MB", "99900, 99.9 kB", "1000, 1.0 kB", "100, 100 bytes", "1, 1 byte"})
    void whatCannotFitIsRefused(long bytes, String limit) {
        Path file = folder.resolve("swim.html");

        assertThatThrownBy(() -> new ReplayHtml("page", List.of(swim("swim", 20, 5)), true).write(file, bytes))
                .isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("expected at most " + limit + ": a larger");
        assertThat(file).doesNotExist();
    }

    @Test
    void waterCanBeLeftOut() {
        Replay swim = swim("swim", 400, 50);

        ReplayHtml.Written with = new ReplayHtml("page", List.of(swim), true).write(folder.resolve("with.html"),
                10_000_000);
        ReplayHtml.Written without = new ReplayHtml("page", List.of(swim), false).write(folder.resolve("no.html"),
                10_000_000);

        assertThat(without.bytes()).isLessThan(with.bytes() - 50 * 400 * 6);
        assertThat(without.largestError()).isZero();
    }
}
