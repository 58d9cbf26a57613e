package io.natator.plot;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.InvalidInputException;
import java.awt.Color;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Set;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class PlotsTest {

    @TempDir
    private Path folder;

    private Path file(String text) throws IOException {
        return Files.writeString(folder.resolve("results.csv"), text);
    }

    private void assertDrawn(String name) throws IOException {
        assertThat(colours(name)).hasSizeGreaterThan(2);
    }

    private Set<Integer> colours(String name) throws IOException {
        BufferedImage image = ImageIO.read(folder.resolve("plots").resolve(name + ".png").toFile());
        int[] pixels = image.getRGB(0, 0, image.getWidth(), image.getHeight(), null, 0, image.getWidth());
        return IntStream.of(pixels).boxed().collect(Collectors.toSet());
    }

    @Test
    void drawsEachSceneOfAPrecisionStudy() throws IOException {
        Path csv = file("""
                scene,scheme,precision,status,run_time,path_error_0.25
                drop,flex,float,ok,0.1,0.01
                drop,flex,double,ok,0.2,0.008
                drop,conserving,float,ok,0.1,0.002
                drop,conserving,float,unstable,0.1,
                chain,conserving,double,ok,0.3,0
                chain,conserving,double,ok,0.2,0.001
                """);

        assertThat(PrecisionPlot.draw(csv, folder.resolve("plots"))).hasSize(2);
        assertDrawn("precision-drop");
        assertDrawn("precision-chain");
    }

    private static final String ROOFLINE = """
            kind,name,scheme,instruction_set,gflops,gbytes_per_second,intensity
            bandwidth,memory,,avx2,,16,
            bandwidth,cache,,avx2,,100,
            stage,density,flex,avx2,25,40,0.625
            """;

    @Test
    void drawsStagesUnderTheirRoofs() throws IOException {
        Path csv = file(ROOFLINE + "compute,multiply-add,,avx2,120,,\n");

        assertThat(RooflinePlot.draw(csv, folder.resolve("plots"))).hasSize(1);
        assertDrawn("roofline-avx2");
    }

    @Test
    void needsThePeakForARoofline() throws IOException {
        Path csv = file(ROOFLINE);

        assertThatThrownBy(() -> RooflinePlot.draw(csv, folder)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("compute");
    }

    private static final String VALIDATION_HEADER =
            "part,case,width,scheme,precision,substeps,iterations,status,run_time,density_error_mean,density_error_max\n";

    @Test
    void drawsFrontsAndDensitiesOfAValidationStudy() throws IOException {
        Path csv = file(VALIDATION_HEADER + """
                dam-break,tall,24,flex,float,4,4,ok,2,,
                tank,thesis/tank,,conserving,float,4,4,ok,3,0.0006,0.002
                tank,thesis/tank,,conserving,float,8,4,ok,6,0.0002,0.0005
                tank,thesis/tank,,flex,float,4,4,unstable,,,
                tank,thesis/tank,,Peer 1.0,,,,published,13.7,0.0005,0.0013
                """);
        Files.writeString(folder.resolve("results-fronts.csv"), """
                case,width,scheme,precision,substeps,iterations,time,position
                tall,,experiment,,,,0.41,1.11
                tall,24,flex,float,4,4,0,1
                tall,24,flex,float,4,4,1,1.5
                tall,24,flex,float,8,4,0,1
                tall,24,flex,float,8,4,1,1.4
                """);

        assertThat(ValidationPlot.draw(csv, folder.resolve("plots"))).hasSize(3);
        assertDrawn("validation-front-tall");
        assertDrawn("validation-density-mean");
        assertDrawn("validation-density-max");
        // Two settings of a scheme in two shades of its colour.
        assertThat(colours("validation-front-tall")).contains(new Color(214, 39, 40).getRGB())
                .anyMatch(pixel -> isPaleRed(new Color(pixel)));
    }

    private static boolean isPaleRed(Color colour) {
        return colour.getRed() > 230 && Math.abs(colour.getGreen() - 162) < 4 && Math.abs(colour.getBlue() - 162) < 4;
    }

    @Test
    void needsTheFrontsBesideAValidationStudy() throws IOException {
        Path csv = file(VALIDATION_HEADER);

        assertThatThrownBy(() -> ValidationPlot.draw(csv, folder)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("results-fronts.csv");
    }
}
