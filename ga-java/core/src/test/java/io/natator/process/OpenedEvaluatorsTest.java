package io.natator.process;

import static io.natator.process.Processes.assertThatNoChildIsLeft;
import static io.natator.process.Processes.assertThatOpenFilesAreAtMost;
import static io.natator.process.Processes.openFiles;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Status;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;

/** What simulator modes of this machine do when something goes wrong, and what is particular to resident processes. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class OpenedEvaluatorsTest {

    @TempDir
    private Path folder;

    @AfterEach
    void nothingIsLeft() throws InterruptedException {
        assertThatNoChildIsLeft();
    }

    /** For an answer, s; reached by failures only. */
    private ExecutionSettings execution(SimulatorMode mode) {
        return FakeSimulator.execution(folder, 300).withMode(mode);
    }

    private static SimulationResult evaluate(ExecutionSettings execution, String scene) throws InterruptedException {
        try (Evaluator evaluator = Evaluator.open(execution)) {
            return evaluator.evaluate(FakeSimulator.request(7, scene));
        }
    }

    @ParameterizedTest
    @EnumSource(value = SimulatorMode.class, mode = EnumSource.Mode.EXCLUDE, names = "SPARK")
    void aHangIsKilledWithItsChildrenAndAFailedResult(SimulatorMode mode) throws InterruptedException {
        SimulationResult result = evaluate(execution(mode).withTimeout(Duration.ofMillis(500)), "fault/hang");

        assertThat(result.status()).isEqualTo(Status.FAILED);
        assertThat(result.error()).startsWith("no answer within 0.5 s");
    }

    @ParameterizedTest
    @EnumSource(value = SimulatorMode.class, mode = EnumSource.Mode.EXCLUDE, names = {"BATCH", "SPARK"})
    void triesOnceMore(SimulatorMode mode) throws InterruptedException {
        assertThat(evaluate(execution(mode), "fault/once").status()).isEqualTo(Status.OK);
    }

    @ParameterizedTest
    @EnumSource(value = SimulatorMode.class, mode = EnumSource.Mode.EXCLUDE, names = "SPARK")
    void aRejectedRequestIsToldOf(SimulatorMode mode) {
        assertThatThrownBy(() -> evaluate(execution(mode), "fault/rejected"))
                .isInstanceOfSatisfying(RequestRejectedException.class, e -> assertThat(e.isBadInput()).isTrue())
                .hasMessage("gait.frequency is 70; expected a number up to 60");
    }

    @ParameterizedTest
    @EnumSource(value = SimulatorMode.class, mode = EnumSource.Mode.EXCLUDE, names = "SPARK")
    void aMissingDeviceIsNoFaultOfTheRequest(SimulatorMode mode) {
        assertThatThrownBy(() -> evaluate(execution(mode).withBackend(Backend.CUDA), "fault/no-device"))
                .isInstanceOfSatisfying(RequestRejectedException.class, e -> assertThat(e.isBadInput()).isFalse())
                .hasMessageContaining("device");
    }

    @ParameterizedTest
    @EnumSource(value = SimulatorMode.class, mode = EnumSource.Mode.EXCLUDE, names = "SPARK")
    void aProgramThatCannotStartIsNoFaultOfTheRequest(SimulatorMode mode) throws IOException {
        Path program = Files.writeString(folder.resolve("program"), "not a program");

        assertThatThrownBy(() -> evaluate(execution(mode).withSimulator(program), "a"))
                .isInstanceOfSatisfying(RequestRejectedException.class, e -> assertThat(e.isBadInput()).isFalse())
                .hasMessageStartingWith("cannot start " + program);
    }

    @ParameterizedTest
    @EnumSource(value = SimulatorMode.class, mode = EnumSource.Mode.EXCLUDE, names = "SPARK")
    void closingFreesWhoWaits(SimulatorMode mode) throws InterruptedException {
        Evaluator evaluator = Evaluator.open(execution(mode));
        List<Exception> outcomes = new ArrayList<>();
        Thread caller = new Thread(() -> {
            try {
                evaluator.evaluate(FakeSimulator.request(1, "fault/hang"));
            } catch (InterruptedException e) {
                outcomes.add(e);
            }
        });
        caller.start();
        Processes.awaitChild();

        evaluator.close();
        caller.join();

        assertThat(outcomes).hasSize(1);
    }

    @ParameterizedTest
    @EnumSource(value = SimulatorMode.class, mode = EnumSource.Mode.EXCLUDE, names = "SPARK")
    void failuresLeakNeitherProcessesNorFileHandles(SimulatorMode mode) throws InterruptedException, IOException {
        try (Evaluator evaluator = Evaluator.open(execution(mode))) {
            evaluator.evaluate(FakeSimulator.request(0, "fault/half"));
            long before = openFiles();
            for (int i = 1; i <= 20; i++) {
                evaluator.evaluate(FakeSimulator.request(i, i % 2 == 0 ? "fault/half" : "thesis/creature-1"));
            }
            assertThatOpenFilesAreAtMost(before + 6);
        }
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "PROCESS|fault/crash|exit status 139", "PROCESS|fault/exit|out of luck",
            "PROCESS|fault/silent|no valid result", "PROCESS|fault/garbage|buffer overflow",
            "PROCESS|fault/half|no valid result", "PROCESS|fault/loud|more than 1048576 bytes",
            "PROCESS|fault/wrong-id|id is 8, not 7", "PROCESS|fault/wrong-exit|status ok with exit status 3",
            "PROCESS|fault/nan|NaN", "PROCESS|fault/infinite|found the number 1e999",
            "PROCESS|fault/two-lines|no valid result", "PROCESS|fault/held-open|output still open",
            "RESIDENT|fault/crash|exit status 139", "RESIDENT|fault/killed|exit status 137",
            "RESIDENT|fault/exit|out of luck", "RESIDENT|fault/silent|output ended",
            "RESIDENT|fault/garbage|buffer overflow", "RESIDENT|fault/half|output ended within a line",
            "RESIDENT|fault/loud|no valid result",
            "RESIDENT|fault/loud-line|more than 1048576 bytes in one line",
            "RESIDENT|fault/wrong-id|id is 8, not 7", "RESIDENT|fault/nan|NaN",
            "RESIDENT|fault/infinite|found the number 1e999", "RESIDENT|fault/deaf|but the program runs on"})
    void aFaultyAnswerIsAFailedResultWithTheReason(SimulatorMode mode, String scene, String reason)
            throws InterruptedException {
        SimulationResult result = evaluate(execution(mode), scene);

        assertThat(result.status()).isEqualTo(Status.FAILED);
        assertThat(result.error()).contains(reason).doesNotContain("\n");
        assertThat(result.score()).isZero();
        assertThat(result.id()).isEqualTo(7);
    }

    @Test
    void oneResidentProcessServesManyEvaluations() throws InterruptedException {
        try (Evaluator simulator = Evaluator.open(execution(SimulatorMode.RESIDENT))) {
            SimulationResult first = simulator.evaluate(FakeSimulator.request(1, "thesis/creature-1"));
            long[] processes = ProcessHandle.current().children().mapToLong(ProcessHandle::pid).toArray();
            SimulationResult second = simulator.evaluate(FakeSimulator.request(2, "thesis/creature-1"));

            assertThat(first.distance()).isEqualTo(-1.3925);
            assertThat(second.distance()).isEqualTo(-1.3925);
            assertThat(processes).hasSize(1);
            assertThat(ProcessHandle.current().children().mapToLong(ProcessHandle::pid)).containsExactly(processes[0]);
        }
    }

    @Test
    void anUnstableResultKeepsTheResidentProcess() throws InterruptedException {
        assertThat(evaluate(execution(SimulatorMode.RESIDENT), "fault/unstable").status()).isEqualTo(Status.UNSTABLE);
    }

    @Test
    void aResidentProcessThatSaysTooMuchCostsTheNextEvaluationNothing() throws InterruptedException {
        try (Evaluator simulator = Evaluator.open(execution(SimulatorMode.RESIDENT))) {
            simulator.evaluate(FakeSimulator.request(1, "fault/two-lines"));
            Thread.sleep(100);

            assertThat(simulator.evaluate(FakeSimulator.request(2, "thesis/creature-1")).status())
                    .isEqualTo(Status.OK);
        }
    }

    @Test
    void aResidentProgramThatDiesAtItsStartIsAFailedResult() throws InterruptedException, IOException {
        Files.createFile(folder.resolve("dies-at-start"));

        assertThat(evaluate(execution(SimulatorMode.RESIDENT), "thesis/creature-1").error())
                .isEqualTo("output ended; exit status 1");
    }
}
