package io.natator.verdict;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.Program;
import io.natator.config.Backend;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.process.FakeSimulator;
import io.natator.protocol.SimulationResult;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class ReproductionTest {

    @TempDir
    private Path run;
    private Path simulator;

    @BeforeEach
    void fake() {
        simulator = FakeSimulator.in(run);
    }

    private static SimulationResult result(double distance, String hash) {
        return new SimulationResult(0L, SimulationResult.Status.OK, distance, "completed", 4.0, 240, "conserving",
                "float", hash, null, null);
    }

    private Reproduction reproduction() {
        BestGait best = new BestGait("thesis/creature-1", List.of(1.0), new Gait(1, List.of(0.1), List.of(0.0)), 0.5521,
                0.138, result(0.5521, "aaaaaaaaaaaaaaaa"), 1.2, null);
        return new Reproduction(run, best, simulator, Backend.CPU, 0);
    }

    private void made(String commit) throws IOException {
        Files.writeString(run.resolve("environment.json"), "{\"natator\":\"0.1\",\"version\":\"0.1.0\",\"commit\":\""
                + commit + "\",\"instructionSet\":\"avx2\",\"backend\":\"cpu\",\"device\":0,\"workers\":2}");
    }

    @Test
    void theSameHashIsTheSameResult() throws InterruptedException {
        assertThat(reproduction().difference(result(0.5521, "aaaaaaaaaaaaaaaa"))).isNull();
        assertThat(reproduction().difference(0.5521, 0)).isNull();
        assertThat(reproduction().difference(0.55211, 1e-4)).isNull();
        assertThat(reproduction().lastFrame()).isEqualTo(240);
    }

    @Test
    void anotherHashIsToldWithWhatIsOtherwise() throws IOException, InterruptedException {
        made("463e5df1d060");
        assertThat(reproduction().difference(result(0.5176, "bbbbbbbbbbbbbbbb"))).isEqualTo(run
                + ": stored 0.5521, today's program 0.5176 (commit 463e5df1d060, now 0123456789ab; "
                + "instruction set avx2, now any)");
        assertThat(reproduction().difference(0.5176, 0)).contains("stored 0.5521, today's program 0.5176");
    }

    @Test
    void oldFoldersSayLess() throws IOException, InterruptedException {
        assertThat(reproduction().difference(0.5, 0)).endsWith("(the folder does not say which program made it)");
        Files.writeString(run.resolve("environment.json"),
                "{\"natator\":\"0.1\",\"simulator\":\"x\",\"simulatorSha256\":\"00\",\"workers\":16}");
        assertThat(reproduction().difference(0.5, 0)).contains("commit not recorded, now 0123456789ab")
                .doesNotContain("backend");
    }

    @Test
    void theSameProgramHasNoReason() throws IOException, InterruptedException {
        Files.writeString(run.resolve("environment.json"), Json.line(Program.at(simulator, Backend.CPU, 0)));
        assertThat(reproduction().difference(0.5, 0)).endsWith("(the same program: no reason is known)");
    }
}
