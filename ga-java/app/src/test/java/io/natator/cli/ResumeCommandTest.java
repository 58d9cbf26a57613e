package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import ch.qos.logback.classic.Logger;
import ch.qos.logback.classic.spi.ILoggingEvent;
import ch.qos.logback.core.read.ListAppender;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.checkpoint.CompactRun;
import io.natator.checkpoint.RunReader;
import io.natator.config.Json;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Consumer;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.slf4j.LoggerFactory;

/** {@code natator resume}: a run that was stopped, moved or damaged goes on. */
class ResumeCommandTest extends FakeSimulatorTest {

    /** Within a generation; where the machine stood still all the time, once more. */
    @Test
    void stopsInTimeAndContinues() throws IOException {
        Files.writeString(folder.resolve("slow"), "0.2");
        ok(evolve("run", "--workers", "1", "--stop-after", "2"));
        for (int i = 0; i < 100 && !Files.exists(folder.resolve("run/evaluations.jsonl")); i++) {
            ok(natator("resume", path("run"), "--workers", "1", "--stop-after", "2"));
        }
        assertThat(err.toString()).endsWith("time is up; continue by: natator resume " + folder.resolve("run") + "\n");
        assertThat(file("run", "evaluations.jsonl").lines()).hasSizeBetween(1, 20);
        Files.delete(folder.resolve("slow"));

        ok(natator("resume", path("run"), "--simulator", "resident"));
        ok(evolve("whole"));

        assertSameRuns("run", "whole");
    }

    /** A simulator that cannot be started any more is no fault of the gaits that it was to swim. */
    @Test
    void aRunWhoseSimulatorIsGoneStopsAndContinues() throws IOException {
        assertThat(evolve("run", "--scene", "fault/locked", "--simulator", "process")).isEqualTo(1);

        Path simulator = folder.resolve("fake-simulator.sh");
        assertThat(err.toString()).contains("natator evolve: simulator: cannot start " + simulator)
                .doesNotContain("simulations failed");
        assertThat(file("run", "evaluations.jsonl")).doesNotContain("\"failed\"");

        assertThat(simulator.toFile().setExecutable(true)).isTrue();
        ok(natator("resume", path("run")));
        ok(evolve("whole", "--scene", "fault/locked"));
        assertSameRuns("run", "whole");
    }

    /** The fake has no GPU, but auto is another backend than cpu all the same. */
    @Test
    void aRunCanMoveToAnotherBackendAndSaysSo() throws IOException {
        Files.writeString(folder.resolve("slow"), "0.5");
        ok(evolve("run", "--stop-after", "0.3"));
        Files.delete(folder.resolve("slow"));

        ok(natator("resume", path("run"), "--backend", "auto"));

        assertThat(err.toString()).startsWith("backend was cpu, is now auto: last digits");
        assertThat(Json.parse(file("run", "config.json"), JsonNode.class).get("backend").asText()).isEqualTo("auto");
        assertThat(Json.parse(file("run", "environment.json"), JsonNode.class).get("backend").asText())
                .isEqualTo("auto");
        ok(natator("resume", path("run")));
        assertThat(err.toString()).doesNotContain("backend was");
    }

    @Test
    void whatFollowsFromTheCheckpointMayBeDamaged() throws IOException {
        ok(evolve("run"));
        String best = file("run", "best.json");
        Files.writeString(folder.resolve("run/best.json"), best.lines().limit(8).collect(Collectors.joining("\n")));
        Files.writeString(folder.resolve("run/savings.json"), "{");
        Files.writeString(folder.resolve("run/check.json"), "{");

        assertThat(warnings(() -> {
            ok(natator("show", path("run"))).contains("best gait of pool/creature-1 after 3 generations",
                    "  flow        Reynolds number 131, Strouhal number 0.313\n");
            ok(natator("resume", path("run")));
        })).as("each once").containsExactly(
                "best " + folder.resolve("run/best.json") + ": ends too early; expected the rest of the JSON text "
                        + "(line 8, column 5); taken from checkpoint.json instead",
                "savings " + folder.resolve("run/savings.json")
                        + ": ends too early; expected the rest of the JSON text (line 1, column 2); shown without it",
                "check " + folder.resolve("run/check.json") + ": ends too early; expected the rest of the JSON text "
                        + "(line 1, column 2); shown without it");
        assertThat(file("run", "best.json")).isEqualTo(best);
    }

    /** What reading a run warns of meanwhile. */
    private static List<String> warnings(Runnable commands) {
        Logger logger = (Logger) LoggerFactory.getLogger(RunReader.class);
        ListAppender<ILoggingEvent> seen = new ListAppender<>();
        seen.start();
        logger.addAppender(seen);
        try {
            commands.run();
        } finally {
            logger.detachAppender(seen);
        }
        return seen.list.stream().map(ILoggingEvent::getFormattedMessage).toList();
    }

    @Test
    void genesThatStandForNothingAreNamed() throws IOException {
        ok(evolve("run"));
        Files.delete(folder.resolve("run/best.json"));
        Path checkpoint = folder.resolve("run/checkpoint.json");
        ObjectNode state = Json.read(checkpoint, ObjectNode.class, "checkpoint");
        ((ArrayNode) state.get("best").get("genes")).set(0, 99);
        Files.writeString(checkpoint, Json.document(state));
        for (String command : List.of("show", "resume")) {
            refused(natator(command, path("run"))).isEqualTo("natator " + command + ": " + folder.resolve("run")
                    + " is damaged: genes of checkpoint.json: gene 1 (frequency) is 99.0; expected a number from 0.5 to 2.0\n");
        }
    }

    @Test
    void aDamagedCountOfSavingsDoesNotStopARun() throws IOException {
        ok(evolve("whole"));
        ok(evolve("run"));
        String before = file("run", "checkpoint.json");
        Files.writeString(folder.resolve("run/savings.json"), "[1");
        Files.delete(folder.resolve("run/checkpoint.json"));

        ok(natator("resume", path("run")));

        assertThat(file("run", "checkpoint.json")).isEqualTo(before);
        assertThat(file("run", "savings.json")).isEqualTo(file("whole", "savings.json"));
    }

    @Test
    void resumingTellsHowFarTheWholeRunIs() throws IOException {
        ok(evolve("run"));
        List<String> all = file("run", "evaluations.jsonl").lines().toList();
        Files.delete(folder.resolve("run/checkpoint.json"));
        Files.write(folder.resolve("run/evaluations.jsonl"), all.subList(0, all.size() - 3));

        ok(natator("resume", path("run")));
        assertThat(err.toString().lines().reduce((first, last) -> last).orElseThrow())
                .startsWith("generation 3 of 3, mean ")
                .contains(", evaluations " + all.size() + " of " + all.size() + ", ");
    }

    @Test
    void aFinishedRunCanHaveMoreGenerations() throws IOException {
        ok(evolve("run", "--starts", "2"));
        String folderName = path("run");
        ok(natator("resume", folderName, "--generations", "5"));
        ok(evolveTo(5, "whole", "--starts", "2"));
        assertSameRuns("run", "whole", "config.json", "savings.json");

        refused(natator("resume", folderName, "--generations", "4"))
                .isEqualTo("natator resume: --generations is 4; expected at least the 5 that are done\n");
        refused(natator("resume", folderName, "--generations", "-1"));
        refused(natator("resume", folderName, "--generations", "60", "--stop-after", "-1"));
        assertThat(natator("resume", folderName, "--generations", "60", "--simulator-path", "/nowhere")).isNotZero();
        assertThat(file("run", "config.json")).as("nothing was begun").isEqualTo(file("whole", "config.json"));
        ok(natator("resume", folderName, "--generations", "5"));
        assertThat(file("run", "checkpoint.json")).isEqualTo(file("whole", "checkpoint.json"));
    }

    @Test
    void whatEndsByItsEvaluationsHasNoMoreGenerations() throws IOException {
        ok(evolve("run", "--evaluations", "20"));
        String config = file("run", "config.json");

        refused(natator("resume", path("run"), "--generations", "9"))
                .isEqualTo("natator resume: " + folder.resolve("run")
                        + " ends after its 20 evaluations, however many --generations it may have\n");
        assertThat(file("run", "config.json")).isEqualTo(config);
    }

    /** Neither an idle resume changes anything, nor one that is refused, nor one whose simulator would refuse. */
    @Test
    void aCompactRunStaysAsItIs() throws IOException {
        ok(evolve("run"));
        String run = path("run");
        ok(natator("resume", run, "--compact"));
        assertThat(folder.resolve("run/evaluations.jsonl")).doesNotExist();
        Map<String, String> before = files();

        ok(natator("resume", run, "--compact"));
        assertThat(files()).isEqualTo(before);

        ok(natator("resume", run));
        assertThat(files()).isEqualTo(before);
        refused(natator("resume", run, "--generations", "2"));
        assertThat(files()).isEqualTo(before);
        ok(natator("resume", run, "--backend", "cuda"));
        assertThat(files()).isEqualTo(before);
    }

    /** Generations by other settings are another experiment: their fitnesses do not compare. */
    @ParameterizedTest
    @ValueSource(strings = {"finished", "compact", "stopped in the first generation"})
    void editedSettingsAreRefused(String how) throws IOException {
        boolean isStopped = how.startsWith("stopped");
        if (isStopped) {
            Files.writeString(folder.resolve("slow"), "0.5");
        }
        ok(evolve("run", "--overrides", "{\"solver\":{\"gravity\":[0,-1,0]}}", "--workers", "1", "--stop-after",
                isStopped ? "1" : "100"));
        Files.deleteIfExists(folder.resolve("slow"));
        assertThat(folder.resolve("run/checkpoint.json").toFile().exists()).isNotEqualTo(isStopped);
        if (how.equals("compact")) {
            CompactRun.compact(folder.resolve("run"));
        }
        String run = path("run");
        String config = file("run", "config.json");
        edit("run/config.json", settings -> {
            settings.put("duration", 3).put("seed", 6).put("population", 9).put("encoding", "sparse")
                    .put("scene", "pool/creature-3").remove("judge");
            settings.withObject("/overrides/solver").put("substeps", 2).remove("gravity");
        });
        Map<String, String> before = files();
        for (String[] command : new String[][] {{"resume", run, "--generations", "9"}, {"resume", run}}) {
            refused(natator(command)).isEqualTo("natator " + command[0] + ": " + folder.resolve("run/config.json")
                    + " was edited after the run was begun: scene was \"pool/creature-1\", is now \"pool/creature-3\"; encoding was \"dense\", is "
                    + "now \"sparse\"; population was 8, is now 9; seed was 5, is now 6; duration was 2.0, is now 3.0; overrides.solver.gravity "
                    + "was [0,-1,0], is now not set; overrides.solver.substeps was not set, is now 2; expected the settings that it was begun "
                    + "with, or a new run\n");
        }
        assertThat(files()).isEqualTo(before);
        ok(natator("show", run));
        assertThat(err.toString()).startsWith("natator show: ")
                .contains("config.json was edited after the run was begun: scene was").hasLineCount(1);

        Files.writeString(folder.resolve("run/config.json"), config);
        ok(natator("resume", run, "--generations", "4"));
    }

    /** A file's scene may be edited: its name says nothing of that. */
    @Test
    void aSceneThatWasChangedIsRefused() throws IOException {
        ok(evolve("run"));
        String run = path("run");
        Files.writeString(folder.resolve("scene"), "{\"what\":\"other water\"}");
        Map<String, String> before = files();

        refused(natator("resume", run, "--generations", "4"))
                .isEqualTo("natator resume: scene pool/creature-1 was changed after " + run
                        + " was begun; expected the scene that it was begun with, or a new run\n");
        assertThat(files()).isEqualTo(before);
        Files.delete(folder.resolve("scene"));
        ok(natator("resume", run, "--generations", "4"));
    }

    /** What a winner does in another scene, or by other settings, is not what it was chosen for, and would stand in the run's folder. */
    @ParameterizedTest
    @ValueSource(strings = {"check", "converge", "compare"})
    void noWinnerIsExaminedInAnotherScene(String command) throws IOException {
        ok(evolve("run"));
        ok(evolve("other"));
        String run = path("run");
        String[] examined = command.equals("compare") ? new String[] {command, path("other"), run}
                : new String[] {command, run};
        Path scene = Files.writeString(folder.resolve("scene"), "{\"what\":\"other water\"}");
        Path config = folder.resolve("run/config.json");
        String settings = Files.readString(config);
        Map<String, String> before = files();

        refused(natator(examined)).startsWith("natator " + command + ": scene pool/creature-1 was changed after ")
                .hasLineCount(1);
        assertThat(files()).isEqualTo(before);
        Files.delete(scene);
        Files.writeString(config, settings.replaceFirst("\"seed\" : \\d+", "\"seed\" : 77"));
        refused(natator(examined))
                .startsWith("natator " + command + ": " + config + " was edited after the run was begun: seed was ")
                .hasLineCount(1);
    }

    @Test
    void aDescriptionOfTheSceneMayBeChanged() throws IOException {
        Path scene = Files.writeString(folder.resolve("scene"),
                "{\"creature\":{\"spacing\":1,\"description\":\"an eel\"},\"description\":\"one\"}");
        ok(evolve("run"));

        Files.writeString(scene, "{\"creature\":{\"description\":\"a conger\",\"spacing\":1}}");
        ok(natator("resume", path("run"), "--generations", "4"));
        Files.writeString(scene, "{\"creature\":{\"spacing\":2}}");
        refused(natator("resume", path("run"), "--generations", "5"));
    }

    @Test
    void aRunThatDoesNotTellItsSceneGoesOn() throws IOException {
        ok(evolve("run"));
        edit("run/environment.json", environment -> environment.remove("sceneSha256"));
        Files.writeString(folder.resolve("scene"), "{\"what\":\"other water\"}");

        ok(natator("resume", path("run"), "--generations", "4"));

        Files.delete(folder.resolve("scene"));
        refused(natator("resume", path("run"), "--generations", "5"));
    }

    @Test
    void howFarARunGoesMayBeEditedAndWhatAnEarlierVersionBeganGoesOn() throws IOException {
        ok(evolve("run"));
        edit("run/config.json", settings -> settings.put("generations", 4).put("evaluations", 1000));
        ok(natator("resume", path("run")));
        assertThat(file("run", "generations.csv").lines()).hasSize(6);

        edit("run/environment.json", environment -> environment.remove("settings"));
        edit("run/config.json", settings -> settings.put("generations", 5).remove("evaluations"));
        ok(natator("resume", path("run")));
        assertThat(Json.parse(file("run", "environment.json"), JsonNode.class).get("settings"))
                .isEqualTo(Json.parse(file("run", "config.json"), JsonNode.class));
    }

    private void edit(String name, Consumer<ObjectNode> change) throws IOException {
        Path file = folder.resolve(name);
        ObjectNode content = Json.read(file, ObjectNode.class, name);
        change.accept(content);
        Files.writeString(file, Json.document(content));
    }

    private Map<String, String> files() throws IOException {
        Map<String, String> content = new TreeMap<>();
        try (Stream<Path> all = Files.list(folder.resolve("run"))) {
            for (Path file : all.filter(Files::isRegularFile).toList()) {
                content.put(file.getFileName().toString(),
                        new String(Files.readAllBytes(file), StandardCharsets.ISO_8859_1));
            }
        }
        return content;
    }

    /** What was computed on the processor is not said to be of another backend because somebody looked at it again. */
    @Test
    void aFinishedRunKeepsItsBackend() throws IOException {
        ok(evolve("run"));
        String before = file("run", "config.json") + file("run", "environment.json");

        ok(natator("resume", path("run"), "--backend", "auto", "--workers", "1"));

        assertThat(err.toString()).startsWith("finished on backend cpu; nothing is left to compute on auto\n");
        assertThat(file("run", "config.json") + file("run", "environment.json")).isEqualTo(before);
    }
}
