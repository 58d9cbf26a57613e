package io.natator.report;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.OptimizerKind;
import io.natator.config.WeightedObjective;
import io.natator.evolution.GenerationSummary;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class FitnessPlotTest {

    private static final EvolutionSettings RUN = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2);

    @TempDir
    private Path folder;

    @Test
    void drawsAPicture() throws IOException {
        List<GenerationSummary> history = List.of(
                GenerationSummary.of(0, new double[] {-0.5, 0.1}, 2, 0, 0),
                GenerationSummary.of(1, new double[] {0.2, 0.3}, 2, 0, 0));

        FitnessPlot.draw(RUN, history, folder);

        BufferedImage image = ImageIO.read(folder.resolve("fitness.png").toFile());
        assertThat(image.getWidth()).isEqualTo(800);
        assertThat(image.getHeight()).isEqualTo(480);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', nullValues = "none", value = {"JGAP|none|distance (scene units)",
        "JGAP|forward=1,straight=0.2|worth by forward=1.0,straight=0.2", "NSGA2|work,distance|worth by work"})
    void theAxisSaysWhatIsDrawn(OptimizerKind optimizer, String objectives, String axis) {
        EvolutionSettings run = RUN.withObjectives(optimizer, objectives == null ? null : WeightedObjective.parse(objectives));

        assertThat(FitnessPlot.chart(run, List.of(GenerationSummary.of(0, new double[] {0.0}, 1, 0, 0))).getYAxisTitle())
                .isEqualTo(axis);
    }

    @Test
    void drawsASingleGeneration() throws IOException {
        FitnessPlot.draw(RUN, List.of(GenerationSummary.of(0, new double[] {0.0}, 1, 0, 0)), folder);

        assertThat(folder.resolve("fitness.png")).isNotEmptyFile();
    }
}
