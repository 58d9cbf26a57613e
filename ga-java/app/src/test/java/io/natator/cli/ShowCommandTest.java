package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.checkpoint.CompactRun;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** {@code natator show}, and what it has in common with {@code natator report}: both read runs that are damaged, or written just now. */
class ShowCommandTest extends FakeSimulatorTest {

    private Path file(String name) {
        return folder.resolve("run").resolve(name);
    }

    private void forget() {
        out.getBuffer().setLength(0);
        err.getBuffer().setLength(0);
    }

    private void evolved(String optimizer) {
        String[] options = optimizer.equals("nsga2") ? new String[] {"--optimizer", optimizer, "--objectives", "distance,work"}
                : new String[] {"--optimizer", optimizer};
        assertThat(evolve("run", options)).as(err.toString()).isZero();
        forget();
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
            String damage = "warning: " + folder.resolve("run") + " is damaged: evaluations.jsonl has " + Math.max(left, 0)
                    + " whole lines; expected at least the " + lines.size() + " of checkpoint.json\n";

            assertThat(natator("show", folder.resolve("run").toString())).isZero();
            assertThat(err.toString()).isEqualTo("natator show: " + damage);
            assertThat(out.toString()).contains("generation 3: best ", "finished", "best gait of pool/creature-1");
            forget();
            assertThat(natator("report", folder.resolve("run").toString())).isIn(0, 2);
            assertThat(err.toString()).startsWith("natator report: " + damage);
            forget();
        }
    }

    @Test
    void aRunUnderWayAndATrimmedOneAreNotDamaged() throws IOException {
        evolved("jgap");
        String checkpoint = Files.readString(file("checkpoint.json"));
        String evaluations = Files.readString(file("evaluations.jsonl"));
        CompactRun.compact(folder.resolve("run"));
        assertThat(natator("show", folder.resolve("run").toString())).isZero();
        Files.writeString(file("checkpoint.json"), checkpoint);
        Files.writeString(file("evaluations.jsonl"), evaluations + evaluations.lines().findFirst().orElseThrow() + "\n{\"gene");
        assertThat(natator("show", folder.resolve("run").toString())).isZero();
        Files.delete(file("checkpoint.json"));
        assertThat(natator("show", folder.resolve("run").toString())).isZero();

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
            assertThat(natator("show", folder.resolve("run").toString())).isZero();
            assertThat(out.toString().lines()).contains("no generation finished, " + left + " evaluations of the first; continue by: natator resume "
                    + folder.resolve("run"));
            forget();
        }
        assertThat(err.toString()).isEmpty();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {"{}|generation: expected a whole number", "null|no value", "{'generation':0}|genes is missing",
        "{'generation':0,'genes':[1]}|result is missing", "{'generation':zero}|found 'zero'; expected JSON (column 15)"})
    void aLineThatIsNoEvaluationIsNamed(String line, String message) throws IOException {
        evolved("map-elites");
        Files.writeString(file("evaluations.jsonl"), line.replace('\'', '"') + "\n");

        assertThat(natator("show", folder.resolve("run").toString())).isEqualTo(2);
        assertThat(err.toString()).startsWith("natator show: " + file("evaluations.jsonl") + ", line 1: " + message).hasLineCount(1);
    }
}
