package io.natator.process;

import static io.natator.process.Processes.assertThatNoChildIsLeft;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.base.InvalidInputException;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Status;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.stream.LongStream;
import java.util.stream.Stream;
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
        return Evaluator
                .open(ExecutionSettings.of(fake).withMode(SimulatorMode.BATCH).withTimeout(Duration.ofMinutes(5))
                        .withCommands(List.of(commands)));
    }

    /** Keeps what it is asked in the file `name`, before it answers: a swim to compare programs by at each start, then the shares. */
    private String noted(String name) {
        return "exec bash -c 'exec " + fake
                + " serve < <(exec 2>/dev/null; while IFS= read -r line; do printf \"%s\\n\" \"$line\" >>"
                + folder.resolve(name) + "; printf \"%s\\n\" \"$line\"; done)'";
    }

    /** Goes on when so many have been started: each has taken its share then. */
    private String met(String name, int count) {
        Path started = folder.resolve("started-");
        return "touch " + started + name + "; until [ $(ls " + started + "* | wc -l) = " + count
                + " ]; do sleep 0.01; done; ";
    }

    /** Answers the swim that programs are compared by and nothing else. */
    private String broken(String name) {
        return "echo started >>" + folder.resolve(name) + "; sed -u 1q | " + fake + " serve";
    }

    private long asked(String name) throws IOException {
        Path file = folder.resolve(name);
        return Files.exists(file) ? Files.readAllLines(file).size() : 0;
    }

    private static List<SimulationRequest> requests(int count) {
        return new ArrayList<>(FakeSimulator.requests(count, "thesis/creature-1"));
    }

    @Test
    void eachGetsItsShare() throws InterruptedException, IOException {
        List<SimulationResult> results;
        try (Evaluator evaluator = open(
                Stream.of("a", "b", "c").map(name -> met(name, 3) + noted(name)).toArray(String[]::new))) {
            results = evaluator.evaluate(requests(41));
        }

        assertThat(results).extracting(SimulationResult::id)
                .containsExactlyElementsOf(LongStream.range(0, 41).boxed().toList());
        assertThat(List.of(asked("a"), asked("b"), asked("c"))).containsExactlyInAnyOrder(1 + 14L, 1 + 14L, 1 + 13L);
    }

    /** Also where it comes late, when the others have done all of a generation; its third share may be out when its second is done. */
    @Test
    void theShareOfOneThatFailsIsDoneByTheOthers() throws InterruptedException, IOException {
        int generations = 0;
        try (Evaluator evaluator = open(broken("broken"), noted("sound"))) {
            for (int more = 6; more > 0 && generations < 1000; generations++) {
                assertThat(evaluator.evaluate(requests(30))).hasSize(30)
                        .allSatisfy(result -> assertThat(result.status()).isEqualTo(Status.OK));
                more -= asked("broken") < 2 ? 0 : 1;
            }
        }

        assertThat(asked("broken")).as("starts of the broken one").isBetween(2L, 3L);
        assertThat(asked("sound")).isEqualTo(1 + generations * 30);
    }

    @Test
    void anEvaluationThatEndsProcessesIsNoFaultOfTheirs() throws InterruptedException, IOException {
        List<SimulationRequest> requests = requests(20);
        requests.set(17, FakeSimulator.request(17, "fault/killed"));
        try (Evaluator evaluator = open(noted("a"), noted("b"))) {
            for (int generation = 0; generation < 4; generation++) {
                for (SimulationResult result : evaluator.evaluate(requests)) {
                    assertThat(result.status()).isEqualTo(result.id() == 17 ? Status.FAILED : Status.OK);
                }
            }
            long a = asked("a");
            long b = asked("b");
            for (int i = 0; i < 1000 && (asked("a") == a || asked("b") == b); i++) {
                evaluator.evaluate(requests(20));  // where one comes late, the other has done all
            }
            assertThat(asked("a")).isGreaterThan(a);
            assertThat(asked("b")).isGreaterThan(b);
        }
    }

    @Test
    void whereAllAreBrokenResultsSayWhy() throws InterruptedException {
        try (Evaluator evaluator = open(broken("a"), broken("b"))) {
            assertThat(evaluator.evaluate(requests(3))).hasSize(3)
                    .allSatisfy(result -> assertThat(result.error()).contains("output ended"));
        }
    }

    @Test
    void aChoiceOfDevicesIsRead() {
        ProgramInfo info = new ProgramInfo("1", null, "any", List.of("0: A", "1: A", "2: B"), null, null);

        assertThat(info.devices("0,1")).containsExactly(0, 1);
        assertThat(info.devices("2")).containsExactly(2);
        assertThat(new ProgramInfo("1", null, "any", List.of("0: A", "1: A"), null, null).devices("all"))
                .containsExactly(0, 1);
        assertThat(new ProgramInfo("1", null, "any", List.of(), null, null).devices("all")).containsExactly(0);
        assertThatThrownBy(() -> info.devices("all")).isInstanceOf(InvalidInputException.class)
                .hasMessage(
                        "--device all are GPUs of several kinds (A; B), whose last digits differ; expected some of one kind");
        assertThatThrownBy(() -> info.devices("1,")).isInstanceOf(InvalidInputException.class)
                .hasMessage("--device is 1,; expected a GPU's number, several with commas between them, or all");
    }
}
