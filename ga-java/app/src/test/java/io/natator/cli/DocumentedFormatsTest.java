package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;

/** The pages that list a format's keys have all of them, with the defaults of its schema. */
class DocumentedFormatsTest {

    private static final Path ROOT = Path.of("../..").toAbsolutePath().normalize();
    private static final Pattern DEFAULT = Pattern.compile("Default: (.*?)\\.$");

    private static JsonNode schema(String name) {
        return Json.read(ROOT.resolve("sim-native/protocol/" + name + ".schema.json"), JsonNode.class, "schema");
    }

    /** Rows of a page that begin with a key. */
    private static List<String> rows(String page, String key) {
        try (Stream<String> lines = Files.lines(ROOT.resolve(page))) {
            return lines.filter(line -> line.matches("\\| [^|]*`" + Pattern.quote(key) + "`.*")).toList();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private static void checkKeys(String page, JsonNode object) {
        for (Map.Entry<String, JsonNode> key : object.path("properties").properties()) {
            String text = key.getValue().path("description").asText();
            if (key.getKey().equals("$schema") || key.getValue().path("$ref").asText().endsWith("clothOnly")) {
                continue;
            }
            List<String> rows = rows(page, key.getKey());
            assertThat(rows).as(key.getKey()).isNotEmpty();
            Matcher value = DEFAULT.matcher(text);
            if (value.find()) {
                assertThat(rows).as(key.getKey()).anyMatch(row -> row.contains("| " + value.group(1) + " |"));
            }
        }
    }

    @Test
    void scenesAndGaits() {
        String page = "sim-native/protocol/scenes.md";
        JsonNode scene = schema("scene");
        List<JsonNode> objects = new ArrayList<>(
                List.of(scene.at("/properties/settling"), scene.at("/properties/stopping"),
                        scene.at("/$defs/solver"), scene.at("/$defs/fluid"), scene.at("/$defs/fluid/properties/mass")));
        for (JsonNode object : objects) {
            assertThat(object.path("properties")).isNotEmpty();
            checkKeys(page, object);
        }
        for (String key : (Iterable<String>) () -> scene.path("properties").fieldNames()) {
            assertThat(key.equals("$schema") ? List.of(key) : rows(page, key)).as(key).isNotEmpty();
        }
        for (String key : (Iterable<String>) () -> schema("gait").path("properties").fieldNames()) {
            assertThat(key.equals("$schema") ? List.of(key) : rows(page, key)).as(key).isNotEmpty();
        }
        objects.add(schema("gait"));
        objects.forEach(object -> checkLists(page, scene, object));
    }

    /** Of a list of numbers the page says what each may be. */
    private static void checkLists(String page, JsonNode schema, JsonNode object) {
        object.path("properties").properties().forEach(key -> {
            String reference = key.getValue().path("$ref").asText("#").substring(1);
            JsonNode each = (reference.isEmpty() ? key.getValue() : schema.at(reference)).path("items");
            if (each.has("minimum")) {
                assertThat(rows(page, key.getKey())).as(key.getKey())
                        .anyMatch(row -> row
                                .contains("each in [" + each.path("minimum") + ", " + each.path("maximum") + "]"));
            }
        });
    }

    @Test
    void results() throws IOException {
        String text = Files.readString(ROOT.resolve("sim-native/docs/results.md"));
        JsonNode ok = schema("result").path("oneOf").get(0).path("properties");
        List<String> keys = new ArrayList<>();
        for (Map.Entry<String, JsonNode> key : ok.properties()) {
            keys.add(key.getKey());
            key.getValue().path("properties").fieldNames().forEachRemaining(keys::add);
        }
        keys.remove("id");
        assertThat(keys).hasSizeGreaterThan(20)
                .allSatisfy(key -> assertThat(text).containsPattern("`(\\w+\\.)?" + key + "[`.]"));
    }

    @Test
    void runFolders() throws IOException {
        String text = Files.readString(ROOT.resolve("ga-java/docs/run-folder.md"));
        Path run = ROOT.resolve("results/quick-evolution/default-seed-1");
        try (Stream<Path> files = Files.list(run)) {
            assertThat(files.map(file -> file.getFileName().toString()).filter(name -> name.contains(".")))
                    .hasSizeGreaterThan(6).allSatisfy(name -> assertThat(text).contains("| `" + name + "` |"));
        }
    }
}
