package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.JavaCommand;
import io.natator.config.Json;
import io.natator.process.FakeSimulator;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.Writer;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** {@code --optimizer external}: this test is the other program, at the other end of standard input and output. */
@Timeout(value = 10, unit = TimeUnit.MINUTES)
class ExternalCommandTest extends CommandTest {

    private static final String EVOLVE = "evolve --creature 1 --optimizer external --population 4 --generations 3 --seed 5";

    private Path log;

    @BeforeEach
    void fake() {
        FakeSimulator.in(folder);
        log = folder.resolve("log.txt");
    }

    private Process start(String line, String... more) throws IOException {
        List<String> words = new ArrayList<>(List.of(line.split(" ")));
        words.addAll(List.of(more));
        words.addAll(List.of("--simulator-path", path("fake-simulator.sh"), "--no-cache", "--simulator", "resident"));
        return new ProcessBuilder(JavaCommand.of(Main.class, words.toArray(String[]::new))).redirectError(log.toFile())
                .start();
    }

    /**
     * Answers it: candidates depend on the generation, the seed and what was told.
     *
     * @param last the generation before which to hang up
     * @return all that was said
     */
    private static List<String> drive(Process natator, int last) throws IOException, InterruptedException {
        List<String> said = new ArrayList<>();
        double seed = 0;
        try (BufferedReader lines = natator.inputReader(); Writer answers = natator.outputWriter()) {
            for (String line = lines.readLine(); line != null; line = lines.readLine()) {
                said.add(line);
                JsonNode message = json(line);
                if (message.get("do").asText().equals("tell")) {
                    seed += message.at("/candidates/0/fitness").asDouble();
                }
                if (message.get("do").asText().equals("ask")) {
                    if (message.get("generation").asInt() == last) {
                        break;
                    }
                    double gene = Math.abs(Math.sin(seed + message.get("generation").asInt()));
                    answers.write("{\"candidates\":[[1," + gene + ",0,0],[1.5,0," + gene + ",0.5]]}\n");
                    answers.flush();
                }
            }
        }
        natator.waitFor();
        return said;
    }

    private static ObjectNode json(String line) {
        try {
            return Json.parse(line, ObjectNode.class);
        } catch (JsonProcessingException e) {
            throw new IllegalArgumentException(line, e);
        }
    }

    @Test
    void itsRunIsAsAllAreAlsoAfterItHasDied() throws IOException, InterruptedException {
        Process whole = start(EVOLVE, "--output-dir", path("whole"));
        List<String> said = drive(whole, -1);
        assertThat(whole.exitValue()).as(Files.readString(log)).isZero();
        assertThat(said).hasSize(1 + 2 * 4 + 1).last().isEqualTo("{\"do\":\"end\"}");
        assertThat(Files.readString(log)).contains("best gait of pool/creature-1 after 3 generations and 8 evaluations",
                "run folder  " + path("whole"));
        ok(execute("show", path("whole"))).contains("external");

        Process dying = start(EVOLVE, "--output-dir", path("dying"));
        drive(dying, 2);
        assertThat(dying.exitValue()).isEqualTo(1);
        assertThat(Files.readAllLines(log)).last().isEqualTo("natator evolve: optimizer: output ended in generation 2; "
                + "what was simulated before is kept, and natator resume goes on from there");
        assertThat(folder.resolve("dying/best.json")).exists();

        Process next = start("resume", path("dying"));
        assertThat(drive(next, -1).get(0)).contains("\"recorded\":2");
        assertThat(next.exitValue()).as(Files.readString(log)).isZero();
        assertSameRuns("dying", "whole");
    }

    @Test
    void whatCannotBeUsedIsOneLine() throws IOException, InterruptedException {
        Process natator = start(EVOLVE, "--output-dir", path("one"));
        try (Writer answers = natator.outputWriter()) {
            answers.write("{\"candidates\":[[1,0,0,0],[1,7,0,0]]}\n");
        }
        List<String> said = natator.inputReader().lines().toList();
        String wrong = "optimizer, line 1: candidate 2: gene 2 (amplitude 1) is 7.0; expected a number from 0.0 to 1.0";
        assertThat(natator.waitFor()).isEqualTo(2);
        assertThat(Files.readAllLines(log)).last().isEqualTo("natator evolve: " + wrong);
        assertThat(said).last().isEqualTo("{\"do\":\"end\",\"error\":\"" + wrong + "\"}");
        assertThat(folder.resolve("one")).doesNotExist();

        refused(execute("evolve", "--optimizer", "external", "--seeds", "2", "--output-dir", path("two"),
                "--simulator-path", path("fake-simulator.sh"))).contains("--seeds goes without --optimizer external");
    }

    /** Nobody waits for an optimizer that thinks for ever. */
    @Test
    void theTimeEndsAWait() throws IOException, InterruptedException {
        Process natator = start(EVOLVE, "--output-dir", path("slow"), "--stop-after", "1");

        assertThat(natator.waitFor()).as(Files.readString(log)).isZero();
        assertThat(Files.readAllLines(log)).last().isEqualTo("time is up; continue by: natator resume " + path("slow"));
    }
}
