package io.natator;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.encoding.Gait;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.EvolutionStoppedException;
import io.natator.process.FakeSimulator;
import io.natator.protocol.SimulationRequest;
import io.natator.run.EvolutionRun;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class NatatorTest {

    @TempDir
    private Path folder;

    @ParameterizedTest
    @ValueSource(strings = {"io.javalin.Javalin",
            "picocli.CommandLine", "me.tongfei.progressbar.ProgressBar", "io.natator.cli.Main",
            "io.natator.view.ViewServer"})
    void whoEmbedsItGetsNoServerNoChartsAndNoCommandLine(String name) {
        assertThatThrownBy(() -> Class.forName(name)).isInstanceOf(ClassNotFoundException.class);
    }

    @Test
    void evaluatesEvolvesAndContinues() throws InterruptedException {
        Natator natator = new Natator(ExecutionSettings.of(FakeSimulator.in(folder)).withWorkers(2));
        SimulationRequest request = SimulationRequest.of("thesis/creature-1",
                new Gait(1.5, List.of(0.1, 0.2), List.of(0.0, 0.3)));
        EvolutionSettings settings = natator.settings("thesis/creature-2").withSize(10, 4);

        assertThat(natator.evaluate(request).distance()).isEqualTo(-1.3925);
        assertThat(settings.problem().encoding()).isEqualTo(EncodingKind.SPARSE);
        EvolutionRun.Outcome whole = natator.evolve(settings, folder.resolve("whole"));
        assertThatThrownBy(() -> natator.evolve(settings, folder.resolve("stopped"), new EvolutionListener() {
            @Override
            public void generationFinished(EvolutionState state) {
                if (state.generation() == 2) {
                    Thread.currentThread().interrupt();
                }
            }
        })).isInstanceOf(EvolutionStoppedException.class);
        assertThat(natator.resume(folder.resolve("stopped"))).isEqualTo(whole);
    }
}
