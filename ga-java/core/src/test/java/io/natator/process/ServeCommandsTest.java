package io.natator.process;

import static io.natator.process.Processes.assertThatNoChildIsLeft;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.base.InvalidInputException;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.config.SimulatorMode;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Status;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ServeCommandsTest {

    @TempDir
    private Path folder;
    private Path fake;

    @BeforeEach
    void fakeSimulator() {
        fake = FakeSimulator.in(folder);
    }

    private ExecutionSettings settings(SimulatorMode mode, String... commands) {
        return ExecutionSettings.of(fake).withMode(mode).withWorkers(2).withTimeout(Duration.ofMinutes(5))
                .withCommands(List.of(commands));
    }

    /** A command that leaves a line in the file `name` when it is started. */
    private String marked(String name) {
        return marked(name, "");
    }

    /** One that then does something else first. */
    private String marked(String name, String first) {
        return "echo started >>" + folder.resolve(name) + "; " + first + "exec " + fake + " serve";
    }

    private static List<SimulationResult> evaluate(ExecutionSettings settings, int requests)
            throws InterruptedException {
        try (Evaluator evaluator = Evaluator.open(settings)) {
            return evaluator.evaluate(FakeSimulator.requests(requests, "thesis/creature-1"));
        } finally {
            assertThatNoChildIsLeft();
        }
    }

    /** Each waits for the other to be started, so that none is left idle before. */
    @Test
    void commandsShareTheEvaluations() throws InterruptedException, IOException {
        String both = "until [ -e " + folder.resolve("a") + " ] && [ -e " + folder.resolve("b")
                + " ]; do sleep 0.01; done; ";

        List<SimulationResult> results = evaluate(
                settings(SimulatorMode.RESIDENT, marked("a", both), marked("b", both)), 6);

        assertThat(results).allSatisfy(result -> assertThat(result.distance()).isEqualTo(-1.3925)).hasSize(6);
        assertThat(Files.readAllLines(folder.resolve("a"))).hasSize(1);
        assertThat(Files.readAllLines(folder.resolve("b"))).hasSize(1);
    }

    @Test
    void aBatchGoesToTheCommand() throws InterruptedException, IOException {
        assertThat(evaluate(settings(SimulatorMode.BATCH, marked("a")), 5)).extracting(SimulationResult::status)
                .containsOnly(Status.OK).hasSize(5);
        assertThat(Files.readAllLines(folder.resolve("a"))).hasSize(1);
    }

    @Test
    void aMachineThatIsAwayHarmsNothing() throws InterruptedException, IOException {
        String away = "echo tried >>" + folder.resolve("away") + "; echo no route to host >&2; exit 255";

        assertThat(evaluate(settings(SimulatorMode.RESIDENT, away, marked("a")), 20))
                .extracting(SimulationResult::status).containsOnly(Status.OK).hasSize(20);
        assertThat(Files.readAllLines(folder.resolve("away"))).as("attempts there").hasSizeBetween(1, 2);
    }

    @Test
    void withoutAnyMachineResultsSayWhy() throws InterruptedException {
        assertThat(evaluate(settings(SimulatorMode.RESIDENT, "echo no route to host >&2; exit 255"), 1)).singleElement()
                .satisfies(result -> {
                    assertThat(result.status()).isEqualTo(Status.FAILED);
                    assertThat(result.error()).contains("exit status 255", "no route to host");
                });
    }

    @ParameterizedTest
    @EnumSource(value = SimulatorMode.class, names = {"RESIDENT", "BATCH"})
    void aProgramThatSwimsOtherwiseIsRefused(SimulatorMode mode) {
        String other = fake + " serve | sed -u 's/\"hash\":\"./\"hash\":\"f/'";

        assertThatThrownBy(() -> evaluate(settings(mode, other), 1))
                .isInstanceOfSatisfying(RequestRejectedException.class, e -> assertThat(e.isBadInput()).isTrue())
                .hasMessageMatching(
                        "--simulator-command \".*\" swims otherwise than this program \\(hash f.*, not 0.*, "
                                + "after 0.05 s\\): another version, instruction set .NATATOR_ISA. or kind of GPU");
    }

    private static void assertRefused(ThrowingCallable settings, String message) {
        assertThatThrownBy(settings).isInstanceOf(InvalidInputException.class).hasMessage(message);
    }

    @Test
    void settingsThatDoNotGoTogetherAreRefused() {
        for (SimulatorMode mode : List.of(SimulatorMode.PROCESS, SimulatorMode.SPARK)) {
            assertRefused(() -> settings(mode, "ssh a natator-sim serve"),
                    "simulator commands keep running; expected simulator mode resident or batch, not "
                            + Json.name(mode));
        }
        assertRefused(() -> settings(SimulatorMode.RESIDENT, " "),
                "simulator command is blank; expected a command line");
        assertRefused(() -> settings(SimulatorMode.SPARK).withBackend(Backend.AUTO),
                "backend is auto; expected cpu or cuda in simulator mode spark, the same on all machines");
        assertRefused(() -> settings(SimulatorMode.BATCH).withMaster("local[2]"),
                "master is local[2]; expected simulator mode spark with it, not batch");
        assertThat(settings(SimulatorMode.SPARK).withMaster("local[2]").withMode(SimulatorMode.RESIDENT).master())
                .isNull();
        for (List<Integer> devices : List.of(List.<Integer>of(), List.of(-1), List.of(1, 1))) {
            assertRefused(() -> settings(SimulatorMode.BATCH).withDevices(devices),
                    "devices are " + devices + "; expected whole numbers from 0, each once");
        }
        assertRefused(() -> settings(SimulatorMode.SPARK).withDevices(List.of(0, 1)),
                "devices are [0, 1]; expected one in simulator mode spark, which gives executors their GPUs");
        assertRefused(() -> Evaluator.open(settings(SimulatorMode.SPARK)),
                "this program has no simulator mode spark; expected natator-spark.jar, started by spark-submit "
                        + "(ga-java/docs/cluster.md)");
    }
}
