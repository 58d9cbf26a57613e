package io.natator.process;

import static io.natator.process.Processes.assertThatNoChildIsLeft;
import static org.assertj.core.api.Assertions.assertThat;

import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Status;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ResidentEvaluatorTest {

    /** For an answer, s; reached by failures only. */
    private static final double PATIENCE = 300;

    @TempDir
    private Path folder;

    private SimulationResult evaluate(String scene, double timeoutSeconds) throws InterruptedException {
        try (Evaluator simulator = new ResidentEvaluator(FakeSimulator.execution(folder, timeoutSeconds))) {
            return simulator.evaluate(FakeSimulator.request(7, scene));
        }
    }

    @Test
    void keepsOneProcessForManyEvaluations() throws InterruptedException {
        try (Evaluator simulator = new ResidentEvaluator(FakeSimulator.execution(folder, PATIENCE))) {
            SimulationResult first = simulator.evaluate(FakeSimulator.request(1, "thesis/creature-1"));
            long[] processes = ProcessHandle.current().children().mapToLong(ProcessHandle::pid).toArray();
            SimulationResult second = simulator.evaluate(FakeSimulator.request(2, "thesis/creature-1"));

            assertThat(first.distance()).isEqualTo(-1.3925);
            assertThat(second.distance()).isEqualTo(-1.3925);
            assertThat(processes).hasSize(1);
            assertThat(ProcessHandle.current().children().mapToLong(ProcessHandle::pid)).containsExactly(processes[0]);
        }
        assertThatNoChildIsLeft();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "fault/crash|exit status 139", "fault/killed|exit status 137", "fault/exit|out of luck",
            "fault/silent|output ended", "fault/garbage|buffer overflow", "fault/half|output ended within a line",
            "fault/loud|no valid result", "fault/loud-line|more than 1048576 bytes in one line",
            "fault/wrong-id|id is 8, not 7", "fault/nan|NaN", "fault/infinite|found the number 1e999",
            "fault/deaf|but the program runs on"})
    void aFaultyAnswerIsAFailedResultWithTheReason(String scene, String reason) throws InterruptedException {
        SimulationResult result = evaluate(scene, PATIENCE);

        assertThat(result.status()).isEqualTo(Status.FAILED);
        assertThat(result.error()).contains(reason).doesNotContain("\n");
        assertThat(result.id()).isEqualTo(7);
        assertThatNoChildIsLeft();
    }

    @Test
    void anUnstableResultKeepsTheProcess() throws InterruptedException {
        assertThat(evaluate("fault/unstable", PATIENCE).status()).isEqualTo(Status.UNSTABLE);
    }

    @Test
    void aProcessThatSaysTooMuchCostsTheNextEvaluationNothing() throws InterruptedException {
        try (Evaluator simulator = new ResidentEvaluator(FakeSimulator.execution(folder, PATIENCE))) {
            simulator.evaluate(FakeSimulator.request(1, "fault/two-lines"));
            Thread.sleep(100);

            assertThat(simulator.evaluate(FakeSimulator.request(2, "thesis/creature-1")).status())
                    .isEqualTo(Status.OK);
        }
    }

    @Test
    void aProgramThatDiesAtItsStartIsAFailedResult() throws InterruptedException, IOException {
        Files.createFile(folder.resolve("dies-at-start"));

        assertThat(evaluate("thesis/creature-1", PATIENCE).error()).isEqualTo("output ended; exit status 1");
    }
}
