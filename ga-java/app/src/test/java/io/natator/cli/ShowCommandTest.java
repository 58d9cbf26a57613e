package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.checkpoint.CompactRun;
import io.natator.config.Json;
import io.natator.evolution.EvaluationRecord;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** {@code natator show}, which reads runs that are damaged, or written just now. */
class ShowCommandTest extends FakeSimulatorTest {

    private Path file(String name) {
        return folder.resolve("run").resolve(name);
    }

    private void evolved(String optimizer) {
        String[] options = optimizer.equals("nsga2")
                ? new String[] {"--optimizer", optimizer, "--objectives", "distance,work"}
                : new String[] {"--optimizer", optimizer};
        ok(evolve("run", options));
    }

    @ParameterizedTest
    @ValueSource(strings = {"jgap", "nsga2", "map-elites"})
    void lostEvaluationsAreSaidAndTheRestIsShown(String optimizer) throws IOException {
        evolved(optimizer);
        List<String> lines = Files.readAllLines(file("evaluations.jsonl"));
        for (int left : new int[] {lines.size() - 1, 0, -1}) {
            if (left < 0) {
                Files.delete(file("evaluations.jsonl"));
            } else {
                Files.write(file("evaluations.jsonl"), lines.subList(0, left));
            }
            String damage = "warning: " + folder.resolve("run") + " is damaged: evaluations.jsonl has "
                    + Math.max(left, 0)
                    + " whole lines; expected at least the " + lines.size() + " of checkpoint.json\n";

            ok(natator("show", path("run")));
            assertThat(err.toString()).isEqualTo("natator show: " + damage);
            assertThat(out.toString()).contains("generation 3: best ", "finished", "best gait of pool/creature-1");
        }
    }

    @Test
    void aRunUnderWayAndATrimmedOneAreNotDamaged() throws IOException {
        evolved("jgap");
        String checkpoint = Files.readString(file("checkpoint.json"));
        String evaluations = Files.readString(file("evaluations.jsonl"));
        EvaluationRecord last = Json.parse(evaluations.lines().reduce((before, line) -> line).orElseThrow(),
                EvaluationRecord.class);
        EvaluationRecord next = new EvaluationRecord(last.generation() + 1, last.genes(), last.gait(),
                last.result().withId(last.result().id() + 1), null);
        CompactRun.compact(folder.resolve("run"));
        showsWithoutWarning();
        Files.writeString(file("checkpoint.json"), checkpoint);
        Files.writeString(file("evaluations.jsonl"), evaluations + Json.line(next) + "\n{\"gene");
        showsWithoutWarning();
        Files.delete(file("checkpoint.json"));
        showsWithoutWarning();
    }

    private void showsWithoutWarning() {
        ok(natator("show", path("run")));
        assertThat(err.toString()).isEmpty();
    }

    @Test
    void aRunWithoutAGenerationTellsWhatItHas() throws IOException {
        evolved("jgap");
        List<String> lines = Files.readAllLines(file("evaluations.jsonl"));
        Files.delete(file("checkpoint.json"));
        Files.delete(file("best.json"));
        for (int left : new int[] {5, 0}) {
            Files.write(file("evaluations.jsonl"), lines.subList(0, left));
            showsWithoutWarning();
            assertThat(out.toString().lines()).contains(
                    "no generation finished, " + left + " evaluations of the first; continue by: natator resume "
                            + folder.resolve("run"));
        }
    }

    @Test
    void evaluationsOutOfOrderAreSaid() throws IOException {
        evolved("jgap");
        List<String> lines = Files.readAllLines(file("evaluations.jsonl"));
        lines.add(3, lines.get(2));
        Files.write(file("evaluations.jsonl"), lines);
        String damage = folder.resolve("run") + " is damaged: evaluations.jsonl, line 4: id is 2; expected 3\n";

        ok(natator("show", path("run")));
        assertThat(err.toString()).isEqualTo("natator show: warning: " + damage);
        refused(natator("resume", path("run"))).isEqualTo("natator resume: " + damage);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {"{}|generation: expected a whole number", "null|expected an object",
            "{'generation':0}|genes is missing",
            "{'generation':0,'genes':[1]}|gait is missing",
            "{'generation':0,'genes':[1],'gait':{'frequency':1,'amplitude':[1],'phase':[0]}}|result is missing",
            "{'generation':0,'genes':[1],'gait':{'frequency':1,'amplitude':[1],'phase':[0]},'result':{'status':'failed','simulated':0}}|id is missing",
            "{'generation':zero}|Unrecognized token 'zero'"})
    void aLineThatIsNoEvaluationIsNamed(String line, String message) throws IOException {
        evolved("map-elites");
        Files.writeString(file("evaluations.jsonl"), line.replace('\'', '"') + "\n");

        refused(natator("show", path("run")))
                .startsWith("natator show: " + file("evaluations.jsonl") + ", line 1: " + message).hasLineCount(1);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "config.json|scene|2|scene is missing",
            "config.json|encoding|2|encoding is missing",
            "checkpoint.json|history|2|history is missing",
            "checkpoint.json|best/result|2|best: result is missing",
            "checkpoint.json|best/result/id|2|best: id is missing",
            "checkpoint.json|best/result/distance|2|best.result: distance is missing",
            "best.json|scene|0|scene is missing",
            "best.json|gait|0|gait is missing",
            "best.json|result|0|result is missing",
            "best.json|vacuum/simulated|0|vacuum: simulated is missing",
            "best.json|fresh/judge|0|fresh: judge is missing",
            "best.json|fresh/base|0|fresh: base is missing",
            "best.json|fresh/base/speed|0|fresh.base: speed is missing",
            "best.json|fresh/base/stopped|0|fresh.base: stopped is null; expected how many runs ended how"})
    void aKeyThatLacksIsNamed(String name, String key, int status, String message) throws IOException {
        evolved("jgap");
        ObjectNode content = Json.read(file(name), ObjectNode.class, name);
        ((ObjectNode) content.at(key.contains("/") ? "/" + key.substring(0, key.lastIndexOf('/')) : ""))
                .remove(key.substring(key.lastIndexOf('/') + 1));
        Files.writeString(file(name), Json.document(content));

        assertThat(natator("show", path("run"))).as(err.toString()).isEqualTo(status);
        if (status == 2) {
            assertThat(err.toString()).contains(file(name) + ": " + message).hasLineCount(1);
        }
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {"0|dense encoding of 0 actuators; expected at least 1",
            "2000000000|actuators is 2000000000; expected at most 100000"})
    void settingsOfAbsurdMusclesAreRefused(String actuators, String message) throws IOException {
        evolved("jgap");
        Files.writeString(file("config.json"),
                Files.readString(file("config.json")).replace("\"actuators\" : 2", "\"actuators\" : " + actuators));

        refused(natator("show", path("run")))
                .startsWith("natator show: settings " + file("config.json") + ": " + message).hasLineCount(1);
    }

    @Test
    void aHistoryWithoutAllGenerationsIsNamed() throws IOException {
        evolved("jgap");
        ObjectNode checkpoint = Json.read(file("checkpoint.json"), ObjectNode.class, "checkpoint");
        ((ArrayNode) checkpoint.get("history")).remove(0);
        Files.writeString(file("checkpoint.json"), Json.document(checkpoint));

        refused(natator("show", path("run"))).startsWith("natator show: checkpoint " + file("checkpoint.json")
                + ": history has 3 generations; expected those from 0 to generation, 3").hasLineCount(1);
    }
}
