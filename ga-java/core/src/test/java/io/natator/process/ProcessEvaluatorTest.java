package io.natator.process;

import static io.natator.process.Processes.assertThatNoChildIsLeft;
import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.ExecutionSettings;
import io.natator.protocol.Results;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Status;
import io.natator.protocol.SwimmingNumbers;
import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ProcessEvaluatorTest {

    /** For an answer, s; reached by failures only. */
    private static final double PATIENCE = 300;

    @TempDir
    private Path folder;

    private SimulationResult evaluate(String scene, double timeoutSeconds) throws InterruptedException {
        try (Evaluator simulator = new ProcessEvaluator(FakeSimulator.execution(folder, timeoutSeconds))) {
            return simulator.evaluate(FakeSimulator.request(7, scene));
        }
    }

    @Test
    void readsAResultAndIgnoresUnknownFields() throws InterruptedException {
        SimulationResult result = evaluate("thesis/creature-1", PATIENCE);

        assertThat(result).isEqualTo(Results.ok(7, -1.3925).withScheme("flex").withHash("0000000052ffdd20"));
        assertThat(result.speed()).isEqualTo(-1.3925 / 4);
    }

    @Test
    void readsTheMechanicsOfASwim() throws InterruptedException {
        SimulationResult result = evaluate("pool/creature-1", PATIENCE);

        assertThat(result.swimming()).isEqualTo(new SwimmingNumbers(0.25, 0.3125, 131.4, 409.6, null, null));
        assertThat(result.work()).isEqualTo(0.75);
    }

    @Test
    void readsAnUnstableResult() throws InterruptedException {
        SimulationResult result = evaluate("fault/unstable", PATIENCE);

        assertThat(result.status()).isEqualTo(Status.UNSTABLE);
        assertThat(result.distance()).isNull();
        assertThat(result.score()).isZero();
        assertThat(result.unstable()).isEqualTo(new SimulationResult.Instability(17, "frame", 0.5, "tank"));
    }

    /** A request larger than a pipe holds, to a program that does not read it. */
    @Test
    void aProgramThatDoesNotReadCannotBlockTheCaller() throws InterruptedException, IOException {
        Path deaf = FakeSimulator.program(folder.resolve("deaf.sh"), "#!/bin/sh\nsleep 3600\n");
        ObjectNode large = JsonNodeFactory.instance.objectNode().put("note", "x".repeat(1 << 20));
        SimulationRequest request = new SimulationRequest(1, "a", null, null, null, large);

        try (Evaluator simulator = new ProcessEvaluator(
                ExecutionSettings.of(deaf).withTimeout(Duration.ofMillis(300)))) {
            assertThat(simulator.evaluate(request).error()).isEqualTo("no answer within 0.3 s");
        }
        assertThatNoChildIsLeft();
    }

    @Test
    void drainsWhatTheProgramLogs() throws InterruptedException {
        assertThat(evaluate("fault/loud-errors", PATIENCE).distance()).isEqualTo(0.5);
    }

    /** As on a machine that has other work; nobody holds the pipes open any more. */
    @Test
    void whatIsReadLateIsReadWhole() throws Exception {
        Path program = FakeSimulator.program(folder.resolve("program.sh"), "#!/bin/sh\necho told\necho why >&2\n");
        try (NativeProgram late = new NativeProgram(program, Duration.ofMinutes(5))) {
            NativeProgram.Output output = late.call(List.of(), "", line -> sleep(3));

            assertThat(output).isEqualTo(new NativeProgram.Output(0, "told\n", "why"));
        }
    }

    private static void sleep(int seconds) {
        try {
            TimeUnit.SECONDS.sleep(seconds);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    @Test
    void interruptionKillsTheProcess() throws InterruptedException {
        try (Evaluator simulator = new ProcessEvaluator(FakeSimulator.execution(folder, PATIENCE))) {
            Thread caller = new Thread(() -> {
                try {
                    simulator.evaluate(FakeSimulator.request(1, "fault/hang"));
                } catch (InterruptedException e) {
                    Thread.currentThread().interrupt();
                }
            });
            caller.start();
            Processes.awaitChild();
            caller.interrupt();
            caller.join();
        }
        assertThatNoChildIsLeft();
    }
}
