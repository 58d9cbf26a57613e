package io.natator.evolution;

import static io.natator.simulator.Processes.assertThatNoChildIsLeft;
import static io.natator.simulator.Processes.assertThatOpenFilesAreAtMost;
import static io.natator.simulator.Processes.openFiles;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.encoding.Gait;
import io.natator.simulator.Evaluator;
import io.natator.simulator.FakeSimulator;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import io.natator.simulator.SimulationResult.Status;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.IntConsumer;
import java.util.stream.LongStream;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** Evolutions whose simulator fails all the time. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class FaultInjectionTest {

    private static final Path REAL = Path.of(System.getProperty("natator.simulator")).normalize();

    @TempDir
    private Path folder;

    /** {@code then} is told how many evaluations there have been. */
    private static List<EvaluationRecord> evolve(EvolutionSettings settings, ExecutionSettings execution,
            IntConsumer then) {
        List<EvaluationRecord> evaluations = new ArrayList<>();
        try (Evaluator evaluator = Evaluator.open(execution)) {
            new Evolution(settings, evaluator, List.of(new EvolutionListener() {
                @Override
                public void evaluated(EvaluationRecord evaluation) {
                    evaluations.add(evaluation);
                    then.accept(evaluations.size());
                }
            }), List.of()).run(null);
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
    void aThousandFaultsCostOnlyTheirOwnEvaluations(SimulatorMode mode, long count, int faults) throws IOException, InterruptedException {
        EvolutionSettings settings = EvolutionSettings.of("fault/chaos", EncodingKind.DENSE, 2)
                .withSize(100, EvolutionSettings.NO_LIMIT).withEvaluations(count);
        ExecutionSettings execution =
                new ExecutionSettings(FakeSimulator.in(folder), 2, Duration.ofSeconds(10)).withMode(mode);
        long filesBefore = openFiles();

        List<EvaluationRecord> evaluations = evolve(settings, execution, done -> { });

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
                assertThat(result.fitness()).isZero();
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

    /** What survives has the bits of an evaluation in peace; what was killed twice says so. */
    @Test
    void theRealSimulatorUnderKill9() throws IOException, InterruptedException {
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
                .withSize(40, EvolutionSettings.NO_LIMIT).withEvaluations(160L).withScene(null, 0.05, null);
        ExecutionSettings execution =
                new ExecutionSettings(REAL, 2, Duration.ofMinutes(5)).withMode(SimulatorMode.RESIDENT);
        long filesBefore = openFiles();
        AtomicInteger kills = new AtomicInteger();
        List<EvaluationRecord> evaluations = evolve(settings, execution, count -> killNowAndThen(count, kills));
        assertThat(evaluations).hasSize(160);
        assertThat(kills.get()).as("processes killed").isGreaterThan(10);
        assertThatNoChildIsLeft();
        assertThatOpenFilesAreAtMost(filesBefore + 4);
        List<SimulationRequest> requests = evaluations.stream()
                .map(one -> new SimulationRequest(one.result().id(), settings.scene(), one.gait(), 0.05, null, null))
                .toList();
        Map<Long, SimulationResult> inPeace = new HashMap<>();
        try (Evaluator evaluator = Evaluator.open(execution)) {
            evaluator.evaluateAll(requests, result -> inPeace.put(result.id(), result));
        }
        for (EvaluationRecord evaluation : evaluations) {
            SimulationResult result = evaluation.result();
            if (result.status() == Status.FAILED) {
                // The second is Java's helper that was killed on its way to become the simulator.
                assertThat(result.error()).containsAnyOf("exit status 137", "signal: 9");
            } else {
                assertThat(result).isEqualTo(inPeace.get(result.id()));
            }
        }
    }

    /** After every fourth evaluation, one process or the other, whatever it is doing. */
    private static void killNowAndThen(int evaluations, AtomicInteger kills) {
        if (evaluations % 4 == 0) {
            ProcessHandle.current().children().skip(evaluations / 4 % 2).findFirst().ifPresent(child -> {
                if (child.destroyForcibly()) {
                    kills.incrementAndGet();
                }
            });
        }
    }
}
