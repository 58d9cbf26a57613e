package io.natator.process;

import static io.natator.process.Processes.assertThatNoChildIsLeft;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import com.fasterxml.jackson.core.JsonGenerator;
import com.fasterxml.jackson.databind.JsonSerializable;
import com.fasterxml.jackson.databind.SerializerProvider;
import com.fasterxml.jackson.databind.jsontype.TypeSerializer;
import com.fasterxml.jackson.databind.node.POJONode;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Status;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.stream.LongStream;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

@Timeout(value = 30, unit = TimeUnit.MINUTES)
class BatchEvaluatorTest {

    /** For an answer, s; reached by failures only. */
    private static final double PATIENCE = 300;

    @TempDir
    private Path folder;

    @AfterEach
    void nothingIsLeft() throws InterruptedException {
        assertThatNoChildIsLeft();
    }

    private List<SimulationResult> evaluate(List<SimulationRequest> requests, double timeoutSeconds)
            throws InterruptedException {
        try (Evaluator evaluator = new BatchEvaluator(FakeSimulator.execution(folder, timeoutSeconds))) {
            return evaluator.evaluate(requests);
        }
    }

    @Test
    void answersAllUnderTheirIds() throws InterruptedException {
        List<SimulationResult> results = evaluate(FakeSimulator.requests(300, "thesis/creature-1"), PATIENCE);

        assertThat(results).extracting(SimulationResult::id)
                .containsExactlyElementsOf(LongStream.range(0, 300).boxed().toList());
        assertThat(results).allSatisfy(result -> assertThat(result.distance()).isEqualTo(-1.3925));
    }

    /** Ids are what the fake's faults depend on; a batch numbers its requests anew from 1. */
    @Test
    void anEvaluationThatEndsTheProcessFailsAlone() throws InterruptedException {
        List<SimulationRequest> requests = new ArrayList<>(FakeSimulator.requests(40, "thesis/creature-1"));
        requests.set(17, FakeSimulator.request(17, "fault/killed"));

        List<SimulationResult> results = evaluate(requests, PATIENCE);

        assertThat(results).hasSize(40);
        for (SimulationResult result : results) {
            assertThat(result.status()).isEqualTo(result.id() == 17 ? Status.FAILED : Status.OK);
        }
        assertThat(results.get(17).error()).contains("exit status 137");
    }

    @Test
    void aHangCostsOneEvaluation() throws InterruptedException {
        List<SimulationRequest> requests = new ArrayList<>(FakeSimulator.requests(4, "thesis/creature-1"));
        requests.set(2, FakeSimulator.request(2, "fault/hang"));

        assertThat(evaluate(requests, 3)).extracting(SimulationResult::status)
                .containsExactly(Status.OK, Status.OK, Status.FAILED, Status.OK);
    }

    @Test
    void aProgramThatNeverAnswersIsGivenUp() throws InterruptedException, IOException {
        Files.createFile(folder.resolve("dies-at-start"));

        List<SimulationResult> results = evaluate(FakeSimulator.requests(1000, "thesis/creature-1"), PATIENCE);

        assertThat(results).hasSize(1000).allSatisfy(result -> assertThat(result.error()).contains("exit status 1"));
    }

    @Test
    void aRejectedRequestEndsItsCallOnly() throws InterruptedException {
        try (Evaluator evaluator = new BatchEvaluator(FakeSimulator.execution(folder, PATIENCE))) {
            assertThatThrownBy(() -> evaluator.evaluate(FakeSimulator.request(1, "fault/rejected")))
                    .isInstanceOf(RequestRejectedException.class).hasMessageContaining("gait.frequency is 70");
            assertThat(evaluator.evaluate(FakeSimulator.request(1, "thesis/creature-1")).status())
                    .isEqualTo(Status.OK);
        }
    }

    /** Whoever asks then, or later, would wait for ever. */
    @Test
    void whatEndsTheThreadThatComputesIsToldToAll() {
        SimulationRequest tooLarge = FakeSimulator.request(1, "thesis/creature-1")
                .withOverrides(new POJONode(new JsonSerializable.Base() {
                    @Override
                    public void serialize(JsonGenerator generator, SerializerProvider serializers) {
                        throw new OutOfMemoryError("no room for a line");
                    }

                    @Override
                    public void serializeWithType(JsonGenerator generator, SerializerProvider serializers,
                            TypeSerializer type) {
                        serialize(generator, serializers);
                    }
                }));
        try (Evaluator evaluator = new BatchEvaluator(FakeSimulator.execution(folder, PATIENCE))) {
            for (SimulationRequest request : List.of(tooLarge, FakeSimulator.request(2, "thesis/creature-1"))) {
                assertThatThrownBy(() -> evaluator.evaluate(request)).isInstanceOf(OutOfMemoryError.class)
                        .hasMessage("no room for a line");
            }
        }
    }

    @Test
    void callersShareTheProcessAndGetTheirOwn() throws InterruptedException {
        List<Thread> callers = new ArrayList<>();
        List<List<SimulationResult>> all = new ArrayList<>();
        try (Evaluator evaluator = new BatchEvaluator(FakeSimulator.execution(folder, PATIENCE))) {
            for (int i = 0; i < 8; i++) {
                List<SimulationResult> own = new ArrayList<>();
                all.add(own);
                callers.add(new Thread(() -> {
                    try {
                        own.addAll(evaluator.evaluate(FakeSimulator.requests(30, "thesis/creature-1")));
                    } catch (InterruptedException e) {
                        Thread.currentThread().interrupt();
                    }
                }));
            }
            callers.forEach(Thread::start);
            for (Thread caller : callers) {
                caller.join();
            }
            assertThat(ProcessHandle.current().children()).hasSize(1);
        }
        assertThat(all).allSatisfy(own -> assertThat(own).extracting(SimulationResult::id)
                .containsExactlyElementsOf(LongStream.range(0, 30).boxed().toList()));
    }
}
