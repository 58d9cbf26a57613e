package io.natator.study.optimizer;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.StoredRun;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Judge;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.ToySimulator;
import io.natator.run.EvolutionRun;
import io.natator.run.RunQueue;
import io.natator.simulator.Evaluator;
import io.natator.simulator.FakeSimulator;
import io.natator.simulator.WorkerPool;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class OptimizerStudyTest {

    private static final int EVALUATIONS = 60;

    @TempDir
    private Path folder;

    private OptimizerStudy study(String name, long evaluations) {
        return study(name, evaluations, 1, 0);
    }

    private OptimizerStudy study(String name, long evaluations, int starts, int rankStarts) {
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-3", EncodingKind.DENSE, 5)
                .withSize(8, EvolutionSettings.NO_LIMIT).withEvaluations(evaluations)
                .withStarts(starts, Judge.MEAN);
        return new OptimizerStudy(Map.of("creature-3", settings), List.of(OptimizerVariant.values()), 3, null,
                rankStarts, folder.resolve(name));
    }

    /** Runs a study; closes the evaluator after some evaluations, as a stop does. */
    private boolean run(OptimizerStudy study, int atOnce, int evaluations) throws InterruptedException {
        Path simulator = folder.resolve("fake-simulator.sh");
        ExecutionSettings execution = new ExecutionSettings(
                Files.exists(simulator) ? simulator : FakeSimulator.in(folder), 2, Duration.ofMinutes(5));
        AtomicInteger left = new AtomicInteger(evaluations);
        try (Evaluator evaluator = new WorkerPool(new ToySimulator(), 2)) {
            Runnable stop = evaluator::close;
            return study.run(execution, evaluator, atOnce, new RunQueue.Watcher() {
                @Override
                public void evaluated() {
                    if (left.decrementAndGet() == 0) {
                        stop.run();
                    }
                }

                @Override
                public void finished(RunFolder run, EvolutionRun.Outcome outcome) {
                    assertThat(StoredRun.isFinished(run.directory())).isTrue();
                }

                @Override
                public EvolutionListener forRun() {
                    return new EvolutionListener() {
                        @Override
                        public void evaluated(EvaluationRecord evaluation) {
                            assertThat(evaluation.result().id()).isLessThan(EVALUATIONS);
                        }
                    };
                }
            });
        }
    }

    @Test
    void aStudyInPiecesWithManyRunsAtOnceIsTheSameToTheByte() throws InterruptedException, IOException {
        OptimizerStudy whole = study("whole", EVALUATIONS);
        assertThat(run(whole, 1, Integer.MAX_VALUE)).isTrue();
        OptimizerStudy pieces = study("pieces", EVALUATIONS);
        int stops = 0;
        while (!run(pieces, 5, 130)) {
            stops++;
        }

        assertThat(stops).isGreaterThan(2);
        assertThat(pieces.finished()).isEqualTo(pieces.size()).isEqualTo(12);
        whole.report("the command");
        pieces.report("the command");
        for (OptimizerVariant variant : OptimizerVariant.values()) {
            for (int seed = 1; seed <= 3; seed++) {
                String run = "creature-3/" + variant.label() + "/seed-" + seed + "/";
                for (String file : List.of("evaluations.jsonl", "generations.csv", "best.json")) {
                    assertThat(folder.resolve("pieces").resolve(run + file))
                            .hasSameBinaryContentAs(folder.resolve("whole").resolve(run + file));
                }
                assertThat(folder.resolve("whole").resolve(run + "evaluations.jsonl").toFile())
                        .satisfies(log -> assertThat(Files.readAllLines(log.toPath())).hasSize(EVALUATIONS));
            }
        }
        for (String file : List.of("README.md", "comparison.csv", "fresh.csv", "tests.csv")) {
            assertThat(folder.resolve("pieces").resolve(file))
                    .hasSameBinaryContentAs(folder.resolve("whole").resolve(file));
        }
        assertThat(Files.readAllLines(folder.resolve("whole/comparison.csv"))).hasSize(1 + 4 * 4);
        // The toy drifts by its frequency less 1 in vacuum.
        double[] drifts = IntStream.rangeClosed(1, 3).mapToDouble(seed -> StoredRun.in(folder.resolve(
                "whole/creature-3/random/seed-" + seed)).best().gait().frequency() - 1.0).sorted().toArray();
        assertThat(Files.readString(folder.resolve("whole/README.md"))).containsPattern(
                "\\| random \\| 8 \\| 3 \\|.*\\| " + String.format("%.4f", drifts[1])
                        + " \\|\n");
        assertThat(folder.resolve("whole/creature-3.png")).isNotEmptyFile();
    }

    /** What is kept of finished runs is all that the page, the table and the other runs need. */
    @Test
    void aStudyThatKeepsALineOfEachRunIsTheSame() throws InterruptedException, IOException {
        OptimizerStudy whole = study("whole", EVALUATIONS);
        run(whole, 1, Integer.MAX_VALUE);
        whole.report("the command");
        assertThat(run(study("lines", EVALUATIONS), 1, 250)).isFalse();
        OptimizerStudy some = study("lines", EVALUATIONS);
        some.compact();
        int before = some.finished();
        assertThat(before).isBetween(1, 11);
        assertThat(folder.resolve("lines/creature-3.jsonl")).content().hasLineCount(before);

        OptimizerStudy rest = study("lines", EVALUATIONS);
        assertThat(rest.finished()).isEqualTo(before);
        assertThat(rest.recorded()).isGreaterThanOrEqualTo((long) before * EVALUATIONS);
        assertThat(run(rest, 2, Integer.MAX_VALUE)).isTrue();
        rest.compact();
        rest.compact();

        OptimizerStudy lines = study("lines", EVALUATIONS);
        assertThat(lines.finished()).isEqualTo(12);
        assertThat(lines.recorded()).isEqualTo(12L * EVALUATIONS);
        lines.report("the command");
        for (String file : List.of("README.md", "comparison.csv", "fresh.csv", "tests.csv")) {
            assertThat(folder.resolve("lines").resolve(file))
                    .hasSameBinaryContentAs(folder.resolve("whole").resolve(file));
        }
        assertThat(folder.resolve("lines/creature-3.jsonl")).content().hasLineCount(12);
        assertThat(folder.resolve("lines/creature-3")).doesNotExist();
        assertThatThrownBy(() -> study("lines", EVALUATIONS + 1)).isInstanceOf(InvalidInputException.class)
                .hasMessageStartingWith(folder.resolve("lines/creature-3.jsonl") + ": ")
                .hasMessageContaining("was begun with other settings");
    }

    @Test
    void aFileThatTheUserPutIntoARunFolderStays() throws InterruptedException, IOException {
        OptimizerStudy study = study("study", EVALUATIONS);
        run(study, 1, Integer.MAX_VALUE);
        Path own = Files.writeString(folder.resolve("study/creature-3/random/seed-2/notes.txt"), "mine");
        study.compact();

        assertThat(own).hasContent("mine");
        try (Stream<Path> left = Files.walk(folder.resolve("study/creature-3"))) {
            assertThat(left.filter(Files::isRegularFile)).containsExactly(own);
        }
    }

    @Test
    void otherSettingsAreRefused() throws InterruptedException {
        run(study("study", EVALUATIONS), 1, 20);

        assertThatThrownBy(() -> run(study("study", EVALUATIONS + 1), 1, 20))
                .isInstanceOf(InvalidInputException.class).hasMessageContaining("was begun with other settings");
    }

    @Test
    void reportsOnNothingAsYet() throws IOException {
        Path page = study("empty", EVALUATIONS).report("the command");

        assertThat(Files.readString(page)).contains("0 of 12 runs are finished");
    }

    @Test
    void quantilesInterpolate() {
        CurveBand band = new CurveBand("any", List.of(new double[] {0, 4}, new double[] {1, 1}, new double[] {3, 3},
            new double[] {2, 2}));

        assertThat(band.quantile(1, 0)).isZero();
        assertThat(band.quantile(1, 0.5)).isEqualTo(1.5);
        assertThat(band.quantile(2, 0.25)).isEqualTo(1.75);
        assertThat(band.quantile(2, 1)).isEqualTo(4);
        assertThat(band.mean(2)).isEqualTo(2.5);
        // Of 1, 2, 3, 4: √(5/3).
        assertThat(band.standardDeviation(2)).isEqualTo(Math.sqrt(5.0 / 3));
    }
}
