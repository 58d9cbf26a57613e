package io.natator.report;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.evolution.GenerationSummary;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class FitnessPlotTest {

    @TempDir
    private Path folder;

    @Test
    void drawsAPicture() throws IOException {
        List<GenerationSummary> history = List.of(
                GenerationSummary.of(0, new double[] {-0.5, 0.1}, 2, 0, 0),
                GenerationSummary.of(1, new double[] {0.2, 0.3}, 2, 0, 0));

        FitnessPlot.draw("title", history, folder);

        BufferedImage image = ImageIO.read(folder.resolve("fitness.png").toFile());
        assertThat(image.getWidth()).isEqualTo(800);
        assertThat(image.getHeight()).isEqualTo(480);
    }

    @Test
    void drawsASingleGeneration() throws IOException {
        FitnessPlot.draw("title", List.of(GenerationSummary.of(0, new double[] {0.0}, 1, 0, 0)), folder);

        assertThat(folder.resolve("fitness.png")).isNotEmptyFile();
    }
}
