package io.natator.study.optimizer;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.file.CsvReader;
import io.natator.file.JsonLines;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** The runs in {@code results/optimizers} are those that the table beside them is about. */
class CommittedRunsTest {

    private static final Path FOLDER = Path.of("..", "..", "results", "optimizers");

    @ParameterizedTest
    @ValueSource(strings = {"creature-1", "creature-2"})
    void theTableFollowsFromTheRuns(String scene) {
        List<RunSummary> runs = JsonLines.read(FOLDER.resolve(scene + ".jsonl"), RunSummary.class);
        List<String> optimizers = runs.stream().map(RunSummary::optimizer).distinct().toList();
        assertThat(optimizers).hasSizeGreaterThan(1);
        assertThat(runs).as("ten seeds of each optimizer").hasSize(10 * optimizers.size());
        assertThat(runs).extracting(run -> run.optimizer() + " " + run.settings().seed()).doesNotHaveDuplicates();
        int rows = 0;
        try (CsvReader table = new CsvReader(FOLDER.resolve("comparison.csv"),
                List.of("scene", "optimizer", "runs", "evaluations", "median", "mean", "least", "greatest"))) {
            while (table.next()) {
                List<RunSummary> own = runs.stream().filter(run -> run.optimizer().equals(table.text("optimizer"))).toList();
                if (table.text("scene").equals(scene) && table.number("evaluations") == own.get(0).evaluations()) {
                    rows++;
                    CurveBand best = new CurveBand("", own.stream().map(run -> new double[] {run.selected()}).toList());
                    assertThat(table.number("runs")).isEqualTo(own.size());
                    assertThat(table.number("median")).isCloseTo(best.quantile(1, 0.5), within(1e-12));
                    assertThat(table.number("mean")).isCloseTo(best.mean(1), within(1e-12));
                    assertThat(table.number("least")).isEqualTo(best.quantile(1, 0));
                    assertThat(table.number("greatest")).isEqualTo(best.quantile(1, 1));
                }
            }
        }
        assertThat(rows).as("optimizers at the end").isEqualTo(optimizers.size());
    }
}
