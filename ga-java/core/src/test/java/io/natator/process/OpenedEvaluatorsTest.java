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
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** What every simulator mode of this machine does alike when something goes wrong. */
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
}
