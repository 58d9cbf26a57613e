package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine;

/** What {@code natator new} writes, the real simulator takes; and the commands that it says are commands. */
class NewCommandTest extends CommandTest {

    private static final String IN_VACUUM = "{\"fluid\":null,\"movingTank\":null,\"settling\":{\"updates\":0}}";

    private Path written(String kind, String name, String... options) throws IOException {
        Path file = folder.resolve(name + ".json");
        List<String> arguments = new ArrayList<>(List.of("new", kind, name, "-o", file.toString()));
        arguments.addAll(List.of(options));
        ok(natator(arguments));
        assertThat(file).exists();
        assertThat(out.toString().lines()).hasSize(3).first().asString().startsWith(file + ": a " + kind);
        return file;
    }

    /** Runs what {@code new} has said should be tried next, as a shell does; {@code view} is left to itself. */
    private List<String> tried() throws IOException, InterruptedException {
        List<String> said = out.toString().lines().skip(1).map(String::strip).toList();
        for (String command : said) {
            if (command.startsWith("natator new ")) {
                ok(natator(command.substring("natator ".length()).split(" ")));
            } else if (command.startsWith("natator-sim ")) {
                String cheap = command.replace(" --duration 2", " --duration 0.02 --overrides '" + IN_VACUUM + "'");
                Process shell = new ProcessBuilder("sh", "-c", "'" + SIMULATOR.getParent() + "'/" + cheap)
                        .redirectErrorStream(true).start();
                String output = new String(shell.getInputStream().readAllBytes());
                assertThat(shell.waitFor(1, TimeUnit.MINUTES)).isTrue();
                assertThat(shell.exitValue()).as(output).isZero();
            }
        }
        return said;
    }

    @ParameterizedTest
    @ValueSource(strings = {"", "--like pool/eel", "--like open-water/ray"})
    void aSceneSwimsByTheGaitThatIsMadeForIt(String options) throws IOException, InterruptedException {
        Path scene = written("scene", "minnow", options.isEmpty() ? new String[0] : options.split(" "));
        List<String> said = tried();

        Path gait = folder.resolve("minnow-gait.json");
        assertThat(said.get(1)).isEqualTo("natator view --scene " + scene + " --gait " + gait);
        ok(natator("evaluate", "--scene", scene.toString(), "--gait", gait.toString(), "--duration", "0.02",
                "--overrides", IN_VACUUM));
        assertThat(Json.parse(out.toString(), JsonNode.class).get("status").asText()).isEqualTo("ok");
    }

    @ParameterizedTest
    @CsvSource({"'',pool/water", "open-water/tuna,open-water/water", "pool/ray,pool/water",
            "thesis/creature-4,thesis/tank",
            "bench/small-tank,pool/water"})
    void aCreatureSwimsInWaterThatTakesIt(String like, String water) throws IOException, InterruptedException {
        Path creature = written("creature", "own", like.isEmpty() ? new String[0] : new String[] {"--like", like});
        List<String> said = tried();

        String put = " " + water + " --overrides '{\"creature\":{\"name\":\"" + creature + "\"}}' --gait";
        assertThat(said).hasSize(2).allMatch(command -> command.contains(put));
        assertThat(Json.read(folder.resolve("own-gait.json"), JsonNode.class, "gait").get("amplitude")).isNotEmpty();
    }

    @Test
    void aFolderMayHaveQuotesInItsName() throws IOException, InterruptedException {
        Path creature = Files.createDirectories(folder.resolve("the \"fish\"")).resolve("own.json");
        ok(natator("new", "creature", "own", "-o", creature.toString()));

        assertThat(tried().get(0)).contains("the \\\"fish\\\"/own.json");
    }

    @Test
    void aGaitDrivesTheMusclesOfItsScene() throws IOException, InterruptedException {
        Path gait = written("gait", "wave", "--like", "thesis/creature-3");

        assertThat(tried().get(0)).isEqualTo("natator-sim run thesis/creature-3 --gait " + gait + " --duration 2");
        JsonNode content = Json.read(gait, JsonNode.class, "gait");
        assertThat(content.get("amplitude")).hasSize(5);
        assertThat(content.get("$schema").asText()).startsWith("file:/").endsWith("/protocol/gait.schema.json");
    }

    @Test
    void aMeshIsFoundFromTheNewFile() throws IOException {
        Path mesh = Files.copy(SIMULATOR.resolveSibling("../share/natator/creatures/ray.obj"),
                folder.resolve("own.obj"));
        Path scene = Files.writeString(folder.resolve("swim.json"), """
                {"base": "pool/water", "creature": {"rearCentre": [0.6, 0.5, 0.5], "particleMass": 0.421875,
                 "mesh": {"file": "%s", "length": 1.2, "joints": [0.3, 0.5]}}}""".formatted(mesh));

        JsonNode creature = Json.read(written("creature", "own", "--like", scene.toString()), JsonNode.class,
                "creature");
        assertThat(creature.at("/mesh/file").asText()).isEqualTo(mesh.toString());
        assertThat(creature.at("/mesh/digest").isMissingNode()).isTrue();
    }

    /** Letters and digits are those of all scripts, with their marks. */
    @ParameterizedTest
    @ValueSource(strings = {"Ålesund-2", "mo\u0308we", "海豚_1", "𐌰"})
    void aNameIsWrittenInAnyScript(String name) throws IOException, InterruptedException {
        Path scene = written("scene", name);

        assertThat(Json.parse(Files.readString(scene), JsonNode.class).get("description").asText())
                .startsWith(name + ": ");
        assertThat(tried()).hasSize(2);
        assertThat(folder.resolve(name + "-gait.json")).exists();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "scene a/b|NAME is a/b; expected at most 64 letters, digits, - and _",
            "scene ..|NAME is ..; expected", "scene é.x|NAME is é.x; expected",
            "scene \u0301|expected at most 64 letters", "scene 🐟|expected",
            "fish x|expected scene, creature or gait but was 'fish'",
            "scene x --output x.txt|--output is x.txt; expected a name that ends in .json",
            "scene x --output TAKEN|taken.json is already there; expected a new file",
            "scene x --output FOLDER/none/x.json|no such file or folder",
            "scene x --like no/such|unknown scene \"no/such\"",
            "creature x --like poool/eel|did you mean pool/eel?",
            "gait x --like no.json|--like is no.json; expected a named scene or an existing file",
            "gait x --like pool/water|has no muscles to drive: it has no creature",
            "scene x --like thesis/tank|--like is thesis/tank, which has no creature",
            "creature x --like pool/water|--like is pool/water, which has no creature"})
    void refusals(String arguments, String message) throws IOException {
        Path taken = Files.writeString(folder.resolve("taken.json"), "mine");
        String where = arguments.contains("--output") ? "" : " --output " + folder.resolve("x.json");

        assertThat(natator(("new " + arguments + where).replace("TAKEN", taken.toString())
                .replace("FOLDER", folder.toString()).split(" "))).isIn(1, CommandLine.ExitCode.USAGE);
        assertThat(err.toString()).startsWith("natator new: ").contains(message).hasLineCount(1);
        assertThat(taken).content().isEqualTo("mine");
        try (Stream<Path> files = Files.list(folder)) {
            assertThat(files).containsExactly(taken);
        }
    }
}
