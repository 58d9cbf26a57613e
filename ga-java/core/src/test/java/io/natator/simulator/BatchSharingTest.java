package io.natator.simulator;

import static io.natator.simulator.Processes.assertThatNoChildIsLeft;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.SimulatorMode;
import io.natator.simulator.SimulationResult.Status;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.stream.LongStream;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** Batches on several GPUs, for which commands stand here. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class BatchSharingTest {

    @TempDir
    private Path folder;
    private Path fake;

    @BeforeEach
    void fakeSimulator() {
        fake = FakeSimulator.in(folder);
    }

    @AfterEach
    void nothingIsLeft() throws InterruptedException {
        assertThatNoChildIsLeft();
    }

    private Evaluator open(String... commands) throws InterruptedException {
        return Evaluator.open(ExecutionSettings.of(fake).withMode(SimulatorMode.BATCH).withTimeout(Duration.ofMinutes(5))
                .withCommands(List.of(commands)));
    }

    /** Keeps what it is asked in the file `name`: a swim to compare programs by at each start, then the shares. */
    private String noted(String name) {
        return "exec bash -c 'exec " + fake + " serve < <(tee -a " + folder.resolve(name) + " 2>/dev/null)'";
    }

    /** Answers the swim that programs are compared by and nothing else. */
    private String broken(String name) {
        return "echo started >>" + folder.resolve(name) + "; sed -u 1q | " + fake + " serve";
    }

    private long asked(String name) throws IOException {
        return Files.readAllLines(folder.resolve(name)).size();
    }

    private static List<SimulationRequest> requests(int count) {
        return new ArrayList<>(LongStream.range(0, count)
                .mapToObj(id -> FakeSimulator.request(id, "thesis/creature-1")).toList());
    }

    private static List<SimulationResult> evaluate(Evaluator evaluator, List<SimulationRequest> requests)
            throws InterruptedException {
        List<SimulationResult> results = new ArrayList<>();
        evaluator.evaluateInOrder(requests, results::add);
        return results;
    }

    @Test
    void eachGetsItsShare() throws InterruptedException, IOException {
        List<SimulationResult> results;
        try (Evaluator evaluator = open(noted("a"), noted("b"), noted("c"))) {
            results = evaluate(evaluator, requests(41));
        }

        assertThat(results).extracting(SimulationResult::id).containsExactlyElementsOf(LongStream.range(0, 41).boxed().toList());
        assertThat(List.of(asked("a"), asked("b"), asked("c"))).containsExactlyInAnyOrder(1 + 14L, 1 + 14L, 1 + 13L);
    }

    @Test
    void theShareOfOneThatFailsIsDoneByTheOthers() throws InterruptedException, IOException {
        try (Evaluator evaluator = open(broken("broken"), noted("sound"))) {
            for (int generation = 0; generation < 4; generation++) {
                assertThat(evaluate(evaluator, requests(30))).hasSize(30)
                        .allSatisfy(result -> assertThat(result.status()).isEqualTo(Status.OK));
            }
        }

        assertThat(asked("broken")).as("starts of the broken one").isEqualTo(2);
        assertThat(asked("sound")).isEqualTo(1 + 4 * 30);
    }

    @Test
    void anEvaluationThatEndsProcessesIsNoFaultOfTheirs() throws InterruptedException, IOException {
        List<SimulationRequest> requests = requests(20);
        requests.set(17, FakeSimulator.request(17, "fault/killed"));
        try (Evaluator evaluator = open(noted("a"), noted("b"))) {
            for (int generation = 0; generation < 4; generation++) {
                for (SimulationResult result : evaluate(evaluator, requests)) {
                    assertThat(result.status()).isEqualTo(result.id() == 17 ? Status.FAILED : Status.OK);
                }
            }
            long a = asked("a");
            long b = asked("b");
            evaluate(evaluator, requests(20));
            assertThat(asked("a")).isGreaterThan(a);
            assertThat(asked("b")).isGreaterThan(b);
        }
    }

    @Test
    void whereAllAreBrokenResultsSayWhy() throws InterruptedException {
        try (Evaluator evaluator = open(broken("a"), broken("b"))) {
            assertThat(evaluate(evaluator, requests(3))).hasSize(3)
                    .allSatisfy(result -> assertThat(result.error()).contains("output ended"));
        }
    }

    @Test
    void aChoiceOfDevicesIsRead() {
        ProgramInfo info = new ProgramInfo("1", null, "any", List.of("0: A", "1: A", "2: B"), null, null);

        assertThat(info.devices("0,1")).containsExactly(0, 1);
        assertThat(info.devices("2")).containsExactly(2);
        assertThat(new ProgramInfo("1", null, "any", List.of("0: A", "1: A"), null, null).devices("all")).containsExactly(0, 1);
        assertThat(new ProgramInfo("1", null, "any", List.of(), null, null).devices("all")).containsExactly(0);
        assertThatThrownBy(() -> info.devices("all")).isInstanceOf(InvalidInputException.class)
                .hasMessage("--device all are GPUs of several kinds (A; B), whose last digits differ; expected some of one kind");
        assertThatThrownBy(() -> info.devices("1,")).isInstanceOf(InvalidInputException.class)
                .hasMessage("--device is 1,; expected a GPU's number, several with commas between them, or all");
    }
}
