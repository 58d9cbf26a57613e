package io.natator.evolution;

import static io.natator.process.Processes.assertThatNoChildIsLeft;
import static io.natator.process.Processes.assertThatOpenFilesAreAtMost;
import static io.natator.process.Processes.openFiles;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.Budget;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.encoding.Gait;
import io.natator.process.Evaluator;
import io.natator.process.FakeSimulator;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Status;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.function.IntConsumer;
import java.util.stream.LongStream;
import java.util.stream.Stream;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;

/** Evolutions whose simulator fails all the time. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class FaultInjectionTest {

    @TempDir
    private Path folder;

    /** Also used where other simulators fail; {@code then} is told how many evaluations there have been. */
    static List<EvaluationRecord> evolve(EvolutionSettings settings, ExecutionSettings execution, IntConsumer then) {
        List<EvaluationRecord> evaluations = new ArrayList<>();
        try (Evaluator evaluator = Evaluator.open(execution)) {
            new Evolution(settings, evaluator, List.of(new EvolutionListener() {
                @Override
                public void evaluated(EvaluationRecord evaluation) {
                    evaluations.add(evaluation);
                    then.accept(evaluations.size());
                }
            }), new RecordedEvaluations(0, List.of()), null).run(null);
        }
        return evaluations;
    }

    /** The formula of the fake. */
    private static double distance(Gait gait) {
        List<Double> numbers = new ArrayList<>(List.of(gait.frequency()));
        numbers.addAll(gait.amplitude());
        numbers.addAll(gait.phase());
        double distance = 0.8;
        for (int i = 0; i < numbers.size(); i++) {
            distance -= Math.pow(numbers.get(i) - 0.35 - 0.1 * i, 2);
        }
        return distance;
    }

    @ParameterizedTest
    @CsvSource({"RESIDENT, 1050, 1000", "PROCESS, 300, 280"})
    void aThousandFaultsCostOnlyTheirOwnEvaluations(SimulatorMode mode, long count, int faults)
            throws IOException, InterruptedException {
        EvolutionSettings settings = EvolutionSettings.of("fault/chaos", EncodingKind.DENSE, 2)
                .withSize(100, Budget.NO_LIMIT).withEvaluations(count);
        ExecutionSettings execution = FakeSimulator.execution(folder)
                .withMode(mode);
        long filesBefore = openFiles();

        List<EvaluationRecord> evaluations = evolve(settings, execution, done -> {
        });

        assertThat(evaluations).extracting(one -> one.result().id())
                .containsExactlyElementsOf(LongStream.range(0, count).boxed().toList());
        int failed = 0;
        for (EvaluationRecord evaluation : evaluations) {
            SimulationResult result = evaluation.result();
            boolean again = Files.exists(folder.resolve("fault-" + result.id() + "-again"));
            assertThat(result.status()).as("evaluation %d: %s", result.id(), result.error())
                    .isEqualTo(again ? Status.FAILED : Status.OK);
            if (again) {
                assertThat(result.error()).isNotBlank();
                assertThat(result.score()).isZero();
                failed++;
            } else {
                assertThat(result.distance()).isCloseTo(distance(evaluation.gait()), within(1e-7));
            }
        }
        assertThat(failed).isGreaterThan((int) count / 12);
        try (Stream<Path> marks = Files.list(folder)) {
            assertThat(marks.filter(mark -> mark.getFileName().toString().startsWith("fault-")).count())
                    .as("injected faults").isGreaterThanOrEqualTo(faults);
        }
        assertThatNoChildIsLeft();
        assertThatOpenFilesAreAtMost(filesBefore + 4);
    }

    /** What else is late by more than the limit, on a machine that has other work, has a second attempt. */
    @ParameterizedTest
    @EnumSource(value = SimulatorMode.class, names = {"RESIDENT", "PROCESS"})
    void programsThatNeverAnswerCostOnlyTheirOwnEvaluations(SimulatorMode mode) throws InterruptedException {
        EvolutionSettings settings = EvolutionSettings.of("fault/idle", EncodingKind.DENSE, 2)
                .withSize(20, Budget.NO_LIMIT).withEvaluations(40L);
        ExecutionSettings execution = FakeSimulator.execution(folder, 3).withMode(mode);

        assertThat(evolve(settings, execution, done -> {
        })).hasSize(40).allSatisfy(evaluation -> {
            SimulationResult result = evaluation.result();
            boolean idle = List.of(17L, 18L).contains(result.id());
            assertThat(result.status()).as("evaluation %d: %s", result.id(), result.error())
                    .isEqualTo(idle ? Status.FAILED : Status.OK);
        });
        assertThatNoChildIsLeft();
    }
}
