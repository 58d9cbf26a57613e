package io.natator.verdict;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.Program;
import io.natator.config.Backend;
import io.natator.config.Json;
import io.natator.process.FakeSimulator;
import io.natator.protocol.Results;
import io.natator.protocol.SimulationResult;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
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
        return Results.ok(distance).withHash(hash);
    }

    private Reproduction reproduction() {
        BestGait best = Winners.best("thesis/creature-1", result(0.5521, "aaaaaaaaaaaaaaaa"), 1.2, null, null);
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
    void aFolderMayNotSayWhichProgramMadeIt() throws InterruptedException {
        assertThat(reproduction().difference(0.5, 0)).endsWith("(the folder does not say which program made it)");
    }

    @Test
    void theSameProgramHasNoReason() throws IOException, InterruptedException {
        Files.writeString(run.resolve("environment.json"), Json.line(Program.at(simulator, Backend.CPU, 0)));
        assertThat(reproduction().difference(0.5, 0)).endsWith("(the same program: no reason is known)");
    }
}
