package io.natator.evolution;

import static io.natator.process.Processes.assertThatNoChildIsLeft;
import static io.natator.process.Processes.assertThatOpenFilesAreAtMost;
import static io.natator.process.Processes.openFiles;
import static org.assertj.core.api.Assertions.assertThat;

import io.natator.config.Budget;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.process.Evaluator;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Status;
import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Evolutions whose simulator, the real one, is killed all the time. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class KilledSimulatorTest {

    private static final Path REAL = Path.of(System.getProperty("natator.simulator")).normalize();

    /** What survives has the bits of an evaluation in peace; what was killed twice says so. */
    @Test
    void theRealSimulatorUnderKill9() throws IOException, InterruptedException {
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
                .withSize(40, Budget.NO_LIMIT).withEvaluations(160L).withScene(null, 0.05, null);
        ExecutionSettings execution = new ExecutionSettings(REAL, 2, Duration.ofMinutes(5))
                .withMode(SimulatorMode.RESIDENT);
        long filesBefore = openFiles();
        AtomicInteger kills = new AtomicInteger();
        List<EvaluationRecord> evaluations = FaultInjectionTest.evolve(settings, execution,
                count -> killNowAndThen(count, kills));
        assertThat(evaluations).hasSize(160);
        assertThat(kills.get()).as("processes killed").isGreaterThan(10);
        assertThatNoChildIsLeft();
        assertThatOpenFilesAreAtMost(filesBefore + 4);
        List<SimulationRequest> requests = evaluations.stream()
                .map(one -> new SimulationRequest(one.result().id(), settings.problem().scene(), one.gait(), 0.05, null,
                        null))
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
