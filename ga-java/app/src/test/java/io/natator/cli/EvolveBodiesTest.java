package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.body.Swimmer;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.RunReader;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.evolution.EvaluationRecord;
import io.natator.protocol.SimulationResult.Status;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** Runs whose bodies are evolved, with a simulator that swims by a formula: best at a length of 1.25. */
class EvolveBodiesTest extends FakeSimulatorTest {

    /** Of the fake's eight actuators. */
    private static final Gait GAIT = new Gait(1.5, List.of(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0),
            List.of(0.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3));

    @Override
    int evolve(String name, String... more) {
        List<String> arguments = new ArrayList<>(List.of("evolve", "--output-dir", path(name)));
        arguments.addAll(List.of(more));
        for (List<String> usual : List.of(List.of("--scene", "pool/eel"), List.of("--population", "8"),
                List.of("--generations", "2"))) {
            if (!arguments.contains(usual.get(0))) {
                arguments.addAll(usual);
            }
        }
        return natator(arguments);
    }

    private String gaitFile() throws IOException {
        return Files.writeString(folder.resolve("gait.json"), Json.line(GAIT)).toString();
    }

    @Test
    void aBestHasItsBodyBesideItsGait() {
        ok(evolve("run", "--evolve", "both", "--encoding", "sparse"));

        RunReader run = RunReader.in(folder.resolve("run"));
        BestGait best = run.best();
        assertThat(run.settings().problem().evolve().body().particles()).isEqualTo(142);
        assertThat(best.swimmer()).isEqualTo(run.settings().problem().genome().decode(best.genes()));
        assertThat(best.bodyLength()).isEqualTo(run.settings().problem().bodyLength(best.body()));
        JsonNode profile = best.body().path("creature").path("profile");
        assertThat(profile.path("length").doubleValue()).isEqualTo(best.genes().get(4)).isBetween(1.125, 1.95);
    }

    /** Kinds of gaits are told apart by beats for a body length, which is each body's own. */
    @Test
    void everyBodyHasItsOwnLength() {
        ok(evolve("run", "--evolve", "both", "--optimizer", "map-elites", "--generations", "1"));

        RunReader run = RunReader.in(folder.resolve("run"));
        assertThat(run.state().population()).isNotEmpty().allSatisfy(one -> {
            double length = run.settings().problem()
                    .bodyLength(run.settings().problem().genome().decode(one.genes()).body());
            assertThat(one.effort().lengths()).isCloseTo(one.result().distance() / length, within(1e-9));
        });
    }

    @Test
    void bodiesAloneGetBetterWithTheSameGait() throws IOException {
        ok(evolve("run", "--evolve", "body", "--gait", gaitFile(), "--generations", "6"));

        RunReader run = RunReader.in(folder.resolve("run"));
        assertThat(run.evaluations()).allSatisfy(one -> assertThat(one.gait()).isEqualTo(GAIT));
        double first = run.bestUntil(0).score();
        assertThat(run.best().selected()).isGreaterThan(first);
        assertThat(run.best().body().path("creature").path("profile").path("length").doubleValue()).isBetween(1.2, 1.3);
    }

    @Test
    void whatIsNoBodyCostsNoSimulationAndSaysWhy() {
        ok(evolve("run", "--evolve", "both", "--population", "20", "--generations", "0"));

        List<EvaluationRecord> refused = RunReader.recorded(folder.resolve("run")).rows().stream()
                .filter(one -> one.result().status() == Status.REFUSED).toList();
        assertThat(refused).hasSizeBetween(1, 9).allSatisfy(one -> {
            assertThat(one.genes().get(16)).isBetween(1.8, 2.0);
            assertThat(one.result().error()).contains("creature.profile.length: the body does not fit into the tank");
            assertThat(one.result().score()).isZero();
        });
        assertThat(RunReader.recorded(folder.resolve("run")).rows()).filteredOn(one -> one.genes().get(16) >= 1.8)
                .hasSameSizeAs(refused);
        natator("show", path("run"));
        assertThat(out.toString()).contains(refused.size() + " of ", " bodies refused, the last, ",
                "does not fit into the tank",
                "early stop  0.0 % of the time: 0 of " + (20 - refused.size())
                        + " evaluations ended early, as if 0 had not");
    }

    @Test
    void theModeAndAKillChangeNoByte() throws IOException {
        for (String mode : List.of("process", "resident", "batch")) {
            ok(evolve(mode, "--evolve", "both", "--simulator", mode, "--population", "6"));
        }
        assertSameRuns("resident", "process", "config.json");
        assertSameRuns("batch", "process", "config.json");

        Path killed = Files.createDirectory(folder.resolve("killed"));
        Files.copy(folder.resolve("batch/config.json"), killed.resolve("config.json"));
        List<String> lines = Files.readAllLines(folder.resolve("batch/evaluations.jsonl"));
        String half = lines.get(13).substring(0, 40);
        Files.writeString(killed.resolve("evaluations.jsonl"), String.join("\n", lines.subList(0, 13)) + "\n" + half);
        ok(natator("resume", killed.toString()));
        assertSameRuns("killed", "process", "config.json");
    }

    @Test
    void aFileOfTheBestSwimsItsBody() throws IOException {
        ok(evolve("run", "--evolve", "both"));
        BestGait best = RunReader.best(folder.resolve("run"));

        ok(natator("evaluate", "--scene", "pool/eel", "--duration", "2", "--gait", path("run/best.json")));

        JsonNode result = Json.read(Files.writeString(folder.resolve("result.json"), out.toString()), JsonNode.class,
                "result");
        assertThat(result.path("distance").doubleValue()).isEqualTo(best.distance());
        assertThat(GaitFile.read(folder.resolve("run/best.json"))).isEqualTo(new Swimmer(best.gait(), best.body()));
        assertThat(SwimSource.of(path("run"), null).overrides()).isEqualTo(best.body());
        ok(natator("show", path("run"), "--generation", "0"));
        Swimmer first = GaitFile.read(Files.writeString(folder.resolve("first.json"), out.toString()));
        assertThat(first).isEqualTo(RunReader.in(folder.resolve("run")).bestUntil(0).swimmer());
        assertThat(first.body().path("creature").has("profile")).isTrue();
        refused(natator("show", path("run"), "--generation", "99")).contains("--generation is 99; expected one that ")
                .contains(" has finished, 0 to ");
    }

    @Test
    void showComparesTheBodyWithTheScenes() {
        ok(evolve("run", "--evolve", "both"));

        ok(natator("show", path("run"))).containsPattern("length +1\\.\\d+ units, the scene's 1\\.5\n")
                .containsPattern(
                        "height +0\\.\\d+ .* units at 0 12 60 100 % of the length, the scene's 0\\.18 0\\.3 0\\.3 0\\.2\n")
                .contains("joints", "stiffness", "muscles", "particles");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "pool/creature-1|both||scene pool/creature-1: the creature's body is not given by a profile",
            "pool/eel|body||--evolve body has no gait that the bodies are to swim with; expected --gait FILE",
            "pool/eel|both|gait.json|--gait is for --evolve body; else gaits are evolved",
            "pool/eel|body|odd.json|--gait FOLDER/odd.json: body is 3; expected a JSON Merge Patch on the scene",
            "pool/eel|body|short.json|gait of the bodies is for 1 actuator; expected one for the 8 of the scene's body"})
    void whatDoesNotFitIsOneLine(String scene, String what, String gait, String message) throws IOException {
        gaitFile();
        Files.writeString(folder.resolve("odd.json"), "{\"gait\":" + Json.line(GAIT) + ",\"body\":3}");
        Files.writeString(folder.resolve("short.json"), Json.line(new Gait(1, List.of(1.0), List.of(0.0))));

        refused(evolve("run", gait == null ? new String[] {"--evolve", what, "--scene", scene}
                : new String[] {"--evolve", what, "--gait", path(gait)}))
                .startsWith("natator evolve: " + message.replace("FOLDER", folder.toString())).hasLineCount(1);
        assertThat(folder.resolve("run")).doesNotExist();
    }
}
