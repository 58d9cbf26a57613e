package io.natator.study.optimizer;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.StoredRun;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.config.Judge;
import io.natator.encoding.Gait;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.GenerationSummary;
import io.natator.evolution.Individual;
import io.natator.evolution.Starts;
import io.natator.evolution.ToySimulator;
import io.natator.file.JsonLines;
import io.natator.run.EvolutionRun;
import io.natator.run.RunQueue;
import io.natator.simulator.Evaluator;
import io.natator.simulator.FakeSimulator;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.WorkerPool;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Optimizers compared by what their best gaits do from fresh starts. */
class FreshComparisonTest {

    private static final int EVALUATIONS = 120;
    private static final int RANK_STARTS = 3;

    @TempDir
    private Path folder;
    private final List<String> said = new ArrayList<>();

    private OptimizerStudy study(int rankStarts) {
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-3", EncodingKind.DENSE, 3)
                .withSize(8, EvolutionSettings.NO_LIMIT).withEvaluations((long) EVALUATIONS).withStarts(2, Judge.MEAN);
        return new OptimizerStudy(Map.of("creature-3", settings), List.of(OptimizerVariant.CMA_ES, OptimizerVariant.RANDOM), 6,
                null, rankStarts, folder);
    }

    private boolean run(OptimizerStudy study) throws InterruptedException {
        Path simulator = folder.resolve("fake-simulator.sh");
        ExecutionSettings execution = new ExecutionSettings(
                Files.exists(simulator) ? simulator : FakeSimulator.in(folder), 2, Duration.ofMinutes(5));
        try (Evaluator evaluator = new WorkerPool(new ToySimulator(), 2)) {
            return study.run(execution, evaluator, 3, new RunQueue.Watcher() {
                @Override
                public void evaluated() {
                    // Nobody counts.
                }

                @Override
                public void finished(RunFolder run, EvolutionRun.Outcome outcome) {
                    // Nobody looks.
                }

                @Override
                public void said(String line) {
                    said.add(line);
                }

                @Override
                public EvolutionListener forRun() {
                    return new EvolutionListener() { };
                }
            });
        }
    }

    /** What the toy swims from starts that no generation had, asked of it directly. */
    private static double again(EvolutionSettings settings, List<Double> genes, int starts) throws InterruptedException {
        Gait gait = settings.encoding().forActuators(settings.actuators()).decode(genes);
        double sum = 0;
        for (int k = 0; k < starts; k++) {
            sum += new ToySimulator().evaluate(new SimulationRequest(1, settings.scene(), gait, null, null, null)
                    .withStart(Starts.fresh(settings.seed(), k))).distance();
        }
        return sum / starts;
    }

    @Test
    void bestGaitsAreComparedByFreshRuns() throws InterruptedException, IOException {
        OptimizerStudy study = study(0);
        assertThat(run(study)).isTrue();
        study.report("the command");

        assertThat(study.compared()).isEqualTo(12);
        assertThat(said).singleElement().asString().matches("running \\d+ gaits again from fresh starts");
        // At the end it is the winners, whose fresh runs each run has itself.
        double[] winners = new double[6];
        for (int seed = 1; seed <= 6; seed++) {
            winners[seed - 1] = StoredRun.in(folder.resolve("creature-3/random/seed-" + seed)).best().fresh().again();
        }
        Arrays.sort(winners);
        List<String[]> medians = Files.readAllLines(folder.resolve("fresh.csv")).stream().map(line -> line.split(",")).toList();
        String[] last = medians.stream().filter(line -> line[1].equals("evaluations") && line[2].equals(EVALUATIONS + ".0")
                && line[3].equals("random")).findFirst().orElseThrow();
        assertThat(last[4]).isEqualTo("6");
        assertThat(Double.parseDouble(last[5])).isCloseTo((winners[2] + winners[3]) / 2, within(1e-12));
        assertThat(Double.parseDouble(last[6])).isBetween(winners[0], winners[2]);
        assertThat(Double.parseDouble(last[7])).isBetween(winners[3], winners[5]);
        // Earlier it is whoever led then.
        List<FreshGait> rows = JsonLines.read(folder.resolve("creature-3-again.jsonl"), FreshGait.class);
        assertThat(rows).isNotEmpty();
        for (FreshGait row : rows) {
            EvolutionSettings settings = StoredRun.settings(
                    folder.resolve("creature-3").resolve(row.optimizer()).resolve("seed-" + row.seed()));
            assertThat(row.runs()).hasSize(4);
            assertThat(Judge.MEAN.of(row.runs())).isCloseTo(again(settings, row.genes(), 4), within(1e-12));
        }
        // All toys swim as long, so that equal time is equal evaluations.
        assertThat(medians.stream().filter(line -> line[1].equals("simulated time")).map(line -> List.of(line).subList(3, 8)))
                .containsExactlyElementsOf(medians.stream().filter(line -> line[1].equals("evaluations"))
                        .map(line -> List.of(line).subList(3, 8)).toList());
        assertThat(Files.readString(folder.resolve("README.md"))).containsPattern(
                "\\| cma-es \\| random \\| -?\\d\\.\\d{4} \\[.*] \\| .* \\| (cma-es further than random|no difference seen) \\(p")
                .containsPattern("\\| all \\| 12 \\| -?\\d+\\.\\d \\[.*] % \\| 0 \\| – \\|");

        said.clear();
        assertThat(run(study(0))).isTrue();
        assertThat(said).isEmpty();
    }

    @Test
    void theLastGenerationIsRankedAnew() throws InterruptedException, IOException {
        assertThat(run(study(RANK_STARTS))).isTrue();

        List<RankedGeneration> rows = JsonLines.read(folder.resolve("creature-3-ranks.jsonl"), RankedGeneration.class);
        assertThat(rows).hasSize(12).allMatch(row -> row.starts() == RANK_STARTS && row.gaits() > 2);
        RankedGeneration row = rows.get(5);
        StoredRun run = StoredRun.in(folder.resolve("creature-3").resolve(row.optimizer()).resolve("seed-" + row.seed()));
        List<Individual> last = run.state().population();
        assertThat(last.stream().map(Individual::genes).distinct()).hasSize(row.gaits()).hasSize(last.size());
        List<Double> before = last.stream().map(Individual::score).toList();
        List<Double> after = new ArrayList<>();
        for (Individual one : last) {
            after.add(again(run.settings(), one.genes(), RANK_STARTS));
        }
        double squares = 0;
        for (int i = 0; i < last.size(); i++) {
            squares += Math.pow(rank(before, i) - rank(after, i), 2);
        }
        double n = last.size();
        assertThat(row.spearman()).isCloseTo(1 - 6 * squares / (n * (n * n - 1)), within(1e-12));
        study(RANK_STARTS).report("the command");
        assertThat(Files.readString(folder.resolve("README.md"))).containsPattern("\\| all \\| 12 \\| .* % \\| 12 \\| -?\\d\\.\\d\\d \\[");
    }

    private static long rank(List<Double> values, int i) {
        return values.stream().filter(value -> value < values.get(i)).count();
    }

    /** A line does not hold the last generation: what is still to be ranked keeps its folder. */
    @Test
    void whatIsNotRankedKeepsItsFolder() throws InterruptedException {
        run(study(0));
        OptimizerStudy ranking = study(RANK_STARTS);
        ranking.compact();
        assertThat(folder.resolve("creature-3.jsonl")).doesNotExist();
        assertThat(ranking.compared()).isZero();

        assertThat(run(ranking)).isTrue();
        assertThat(said).last().asString().isEqualTo("running 0 gaits again from fresh starts, and ranking the last generations of "
                + "12 runs");
        ranking.compact();
        assertThat(folder.resolve("creature-3")).doesNotExist();
        assertThat(run(study(RANK_STARTS))).isTrue();
        assertThatThrownBy(() -> study(RANK_STARTS + 1)).isInstanceOf(InvalidInputException.class).hasMessage("--rank-starts is "
                + "4; the last generation of 12 runs, which --compact left only a line of, can no longer be ranked from so many");
    }

    /** A study of a program that knew neither who led nor fresh runs: its winners are run again, and what is not known is left out. */
    @Test
    void linesOfAnOlderProgramAreRead() throws InterruptedException, IOException {
        OptimizerStudy study = study(0);
        run(study);
        study.compact();
        Path file = folder.resolve("creature-3.jsonl");
        List<String> old = new ArrayList<>();
        for (String line : Files.readAllLines(file)) {
            ObjectNode row = Json.parse(line, ObjectNode.class);
            row.get("improvements").forEach(one -> ((ObjectNode) one).remove(List.of("simulated", "genes")));
            ((ObjectNode) row.get("best")).remove(List.of("fresh", "selected", "runs"));
            ((ObjectNode) row.get("statistics")).remove("simulatedSeconds");
            old.add(row.toString());
        }
        Files.write(file, old);
        Files.delete(folder.resolve("creature-3-again.jsonl"));
        said.clear();

        OptimizerStudy again = study(0);
        assertThat(run(again)).isTrue();
        again.report("the command");

        assertThat(said).containsExactly("running 12 gaits again from fresh starts");
        assertThat(Files.readString(folder.resolve("README.md"))).contains("At equal simulated time:\n\nnot recorded by these runs")
                .containsPattern("\\| random \\| 6 \\| – \\| – \\| – \\| -?\\d\\.\\d{4} \\[");
        try (Stream<String> lines = Files.lines(folder.resolve("fresh.csv"))) {
            assertThat(lines).hasSize(1 + 2);
        }
    }

    /** Of two runs the one whose evaluations end early has had more of them, and another leader, in the same time. */
    @Test
    void equalTimeIsNotEqualEvaluations() {
        RunSummary slow = summary(400, List.of(new RunSummary.Improvement(0, 0.1, 4.0, List.of(1.0)),
                new RunSummary.Improvement(20, 0.2, 84.0, List.of(2.0)), new RunSummary.Improvement(60, 0.3, 244.0, List.of(3.0)),
                new RunSummary.Improvement(61, 0.25, 248.0, null)));
        RunSummary quick = summary(100, List.of());
        List<RunSummary> both = List.of(slow, quick);

        assertThat(EqualBudget.SIMULATED_TIME.at(1, both)).isEqualTo(100);
        assertThat(slow.leader(EqualBudget.SIMULATED_TIME, 100)).containsExactly(2.0);
        assertThat(slow.leader(EqualBudget.SIMULATED_TIME, 83)).containsExactly(1.0);
        assertThat(slow.leader(EqualBudget.SIMULATED_TIME, 3)).isNull();
        assertThat(slow.leader(EqualBudget.EVALUATIONS, EqualBudget.EVALUATIONS.at(0.5, both))).containsExactly(2.0);
        assertThat(slow.leader(EqualBudget.EVALUATIONS, 62)).containsExactly(3.0);
        assertThat(slow.leader(EqualBudget.EVALUATIONS, 1)).containsExactly(1.0);
    }

    private static RunSummary summary(double seconds, List<RunSummary.Improvement> improvements) {
        ObjectNode statistics = JsonNodeFactory.instance.objectNode();
        statistics.put("simulatedSeconds", seconds);
        return new RunSummary("any", EvolutionSettings.of("thesis/creature-3", EncodingKind.DENSE, 3), null, statistics, null,
                List.of(new GenerationSummary(0, 1, 1, 1, 1, 100, 100, 0, 0)), improvements);
    }
}
