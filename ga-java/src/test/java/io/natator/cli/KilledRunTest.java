package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.simulator.FakeSimulator;
import java.io.File;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** The program as a process of its own, killed as by {@code kill -9} or ended as by Ctrl-C, and continued. */
@Timeout(value = 90, unit = TimeUnit.SECONDS)
class KilledRunTest {

    private static final int KILLS = 6;

    @TempDir
    private Path folder;

    private ProcessBuilder natator(String... arguments) {
        List<String> command = new ArrayList<>(List.of(
                Path.of(System.getProperty("java.home"), "bin", "java").toString(), "-XX:TieredStopAtLevel=1", "-cp",
                System.getProperty("java.class.path"), Main.class.getName(), "evolve", "--simulator-path",
                folder.resolve("fake-simulator.sh").toString()));
        command.addAll(List.of(arguments));
        return new ProcessBuilder(command).redirectErrorStream(true)
                .redirectOutput(new File(folder.toFile(), "log.txt"));
    }

    private ProcessBuilder start(Path run) {
        return natator("--population", "20", "--generations", "8", "--workers", "2", "--output-dir", run.toString());
    }

    @Test
    void resumesExactly() throws IOException, InterruptedException {
        FakeSimulator.in(folder);
        Path whole = folder.resolve("whole");
        Path killed = folder.resolve("killed");
        assertThat(start(whole).start().waitFor()).as(Files.readString(folder.resolve("log.txt"))).isZero();

        Random random = new Random(1);
        int kills = killWhenRunning(start(killed), killed, random) ? 1 : 0;
        while (kills < KILLS && killWhenRunning(natator("--workers", "2", "--resume", killed.toString()), killed, random)) {
            kills++;
        }
        assertThat(kills).as("runs killed before their end").isGreaterThanOrEqualTo(2);
        assertThat(natator("--resume", killed.toString()).start().waitFor()).isZero();

        for (String name : List.of("generations.csv", "best.json", "checkpoint.json", "evaluations.jsonl")) {
            assertThat(killed.resolve(name)).hasSameTextualContentAs(whole.resolve(name));
        }
    }

    /** Kills a run some time after it has written an evaluation; false if it ended before. */
    private static boolean killWhenRunning(ProcessBuilder builder, Path run, Random random)
            throws IOException, InterruptedException {
        Path log = run.resolve("evaluations.jsonl");
        long before = Files.exists(log) ? Files.size(log) : 0;
        Process process = builder.start();
        while (process.isAlive() && (!Files.exists(log) || Files.size(log) <= before)) {
            Thread.sleep(5);
        }
        Thread.sleep(random.nextInt(150));
        boolean alive = process.isAlive();
        (random.nextBoolean() ? process.destroyForcibly() : endPolitely(process)).waitFor();
        return alive;
    }

    private static Process endPolitely(Process process) {
        process.destroy();
        return process;
    }
}
