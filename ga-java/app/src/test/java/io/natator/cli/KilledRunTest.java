package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.JavaCommand;
import io.natator.checkpoint.RunFiles;
import io.natator.process.FakeSimulator;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.Writer;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * The program as a process of its own: killed as by {@code kill -9}, ended as by Ctrl-C, without room to write. Each end costs a
 * start of the program, so there are few; {@code -Dnatator.kills=4} makes them four times as many.
 */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class KilledRunTest {

    private static final List<String> HOW = List.of("--simulator", "resident", "--workers", "2", "--no-cache",
            "--timeout", "3600");
    private static final List<String> SETTINGS = List.of("--creature", "1", "--population", "30", "--evaluations",
            "150");
    /** Answers that a simulator gives at most until it waits to be killed: no run gets to its end between two kills. */
    private static final String ANSWERS = "4";
    private static final int TIMES = Integer.getInteger("natator.kills", 1);

    @TempDir
    private Path folder;
    private Path log;

    @BeforeEach
    void fake() throws IOException {
        FakeSimulator.in(folder);
        // An evaluation takes 10 ms, so that a run lasts long enough to be killed many times.
        Files.writeString(folder.resolve("slow"), "0.01");
        log = folder.resolve("log.txt");
    }

    private List<String> command(String name, String... arguments) {
        List<String> command = JavaCommand.of(Main.class, name, "--simulator-path",
                folder.resolve("fake-simulator.sh").toString());
        command.addAll(List.of(arguments));
        return command;
    }

    private Process start(List<String> command) throws IOException {
        return new ProcessBuilder(command).redirectErrorStream(true).redirectOutput(log.toFile()).start();
    }

    /** A run without any trouble, in this process. */
    private Path whole(String... more) throws IOException {
        Path run = folder.resolve("whole");
        Path slow = folder.resolve("slow");
        Files.delete(slow);
        List<String> command = evolve(run, more);
        PrintWriter nowhere = new PrintWriter(Writer.nullWriter());
        assertThat(Main.commandLine().setOut(nowhere).setErr(nowhere)
                .execute(command.subList(command.indexOf("evolve"), command.size()).toArray(String[]::new))).isZero();
        Files.writeString(slow, "0.01");
        return run;
    }

    private List<String> evolve(Path run, String... more) {
        List<String> command = command("evolve", "--output-dir", run.toString());
        command.addAll(HOW);
        command.addAll(SETTINGS);
        command.addAll(List.of(more));
        return command;
    }

    @ParameterizedTest
    @CsvSource({"jgap, 4, 1", "cma-es, 3, 1", "random, 3, 1", "jgap, 3, 3", "cma-es, 3, 3"})
    void killsChangeNothing(String optimizer, int kills, String starts) throws IOException, InterruptedException {
        Path whole = whole("--optimizer", optimizer, "--starts", starts);
        Path run = folder.resolve("killed");
        Files.writeString(folder.resolve("most"), ANSWERS);
        Random random = new Random(kills);
        assertThat(ended(start(evolve(run, "--optimizer", optimizer, "--starts", starts)), run, random, true)).isTrue();
        for (int i = 1; i < kills * TIMES; i++) {
            boolean force = i % 8 != 4;
            Process next = start(
                    command("resume", "--no-cache", "--simulator", "resident", "--workers", "2", "--timeout",
                            "3600", run.toString()));
            assertThat(ended(next, run, random, force)).as("end %d came before that of the run", i).isTrue();
        }
        Files.delete(folder.resolve("slow"));
        Files.delete(folder.resolve("most"));

        assertThat(start(command("resume", "--no-cache", "--simulator", "resident", run.toString())).waitFor())
                .as(Files.readString(log)).isZero();

        RunFiles.assertSame(run, whole);
    }

    /**
     * Ends a process soon after it has written an evaluation, or at any moment before.
     *
     * @param force as by {@code kill -9}, else as by Ctrl-C
     * @return false if it had ended by itself
     */
    private boolean ended(Process process, Path run, Random random, boolean force)
            throws IOException, InterruptedException {
        long before = evaluated(run);
        if (force && before > 0 && random.nextInt(3) == 0) {
            Thread.sleep(random.nextInt(300));
        } else {
            while (process.isAlive() && evaluated(run) <= before) {
                Thread.sleep(2);
            }
            Thread.sleep(random.nextInt(60));
        }
        boolean alive = process.isAlive();
        if (force) {
            process.destroyForcibly();
        } else {
            process.destroy();
        }
        process.waitFor();
        if (!force) {
            assertThat(Files.readString(log)).contains("interrupted; continue by: natator resume " + run)
                    .doesNotContain("Exception", "internal error");
        }
        return alive;
    }

    /** Bytes of evaluations that a run has written. */
    private static long evaluated(Path run) {
        return run.resolve("evaluations.jsonl").toFile().length();
    }

    /** A limit on the size of files ends a write as a full disk does. */
    @Test
    void aFullDiskIsOneLineAndLosesNothing() throws IOException, InterruptedException {
        Path whole = whole();
        Path run = folder.resolve("full");
        Files.delete(folder.resolve("slow"));
        List<String> limited = new ArrayList<>(List.of("bash", "-c", "ulimit -f 20; exec \"$@\"", "natator"));
        limited.addAll(evolve(run));

        assertThat(start(limited).waitFor()).isEqualTo(1);

        assertThat(Files.readAllLines(log)).last().asString().startsWith("natator evolve: cannot write " + run)
                .contains("File too large");
        assertThat(Files.size(run.resolve("evaluations.jsonl"))).isGreaterThan(10_000);
        assertThat(start(command("resume", "--no-cache", "--simulator", "resident", run.toString())).waitFor())
                .as(Files.readString(log)).isZero();
        RunFiles.assertSame(run, whole);
    }

    @ParameterizedTest
    @ValueSource(strings = {">&-", ">/dev/full"})
    void aClosedOutputLosesNothing(String redirection) throws IOException, InterruptedException {
        Path whole = whole();
        Path run = folder.resolve("closed");
        Files.delete(folder.resolve("slow"));
        List<String> closed = new ArrayList<>(List.of("bash", "-c", "exec \"$@\" " + redirection, "natator"));
        closed.addAll(evolve(run));
        Process process = new ProcessBuilder(closed).redirectError(log.toFile()).start();

        assertThat(process.waitFor()).isEqualTo(1);

        assertThat(Files.readAllLines(log)).last().isEqualTo("natator: standard output cannot be written");
        RunFiles.assertSame(run, whole);
    }
}
