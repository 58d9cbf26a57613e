package io.natator.plot;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class PlotsTest {

    @TempDir
    private Path folder;

    private Path file(String text) throws IOException {
        return Files.writeString(folder.resolve("results.csv"), text);
    }

    private void assertDrawn(String name) throws IOException {
        assertThat(folder.resolve("plots").resolve(name + ".png")).isNotEmptyFile();
        assertThat(Files.readString(folder.resolve("plots").resolve(name + ".svg"))).contains("<svg")
                .hasSizeLessThan(300_000);
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

    @Test
    void drawsAMapForEachScheme() throws IOException {
        Path csv = file("""
                scheme,precision,axis,value,second_axis,second_value,status
                flex,float,dt,1,,,ok
                flex,float,dt,1,iterations,4,ok
                flex,float,dt,2,iterations,4,diverged
                flex,float,dt,10,iterations,4,unstable
                conserving,float,dt,1,iterations,4,ok
                """);

        assertThat(StabilityPlot.draw(csv, folder.resolve("plots"))).hasSize(2);
        assertDrawn("stability-flex-float-dt-iterations");
        assertDrawn("stability-conserving-float-dt-iterations");
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
        assertThat(Files.readString(folder.resolve("plots/validation-front-tall.svg")))
                .contains("stroke:rgb(214,39,40);stroke-opacity:0.43").contains("stroke:rgb(214,39,40);stroke-width");
    }

    @Test
    void needsTheFrontsBesideAValidationStudy() throws IOException {
        Path csv = file(VALIDATION_HEADER);

        assertThatThrownBy(() -> ValidationPlot.draw(csv, folder)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("results-fronts.csv");
    }

    @Test
    void refusesAnUnknownStatus() throws IOException {
        Path csv = file("""
                scheme,precision,axis,value,second_axis,second_value,status
                flex,float,dt,1,iterations,4,fine
                """);

        assertThatThrownBy(() -> StabilityPlot.draw(csv, folder)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("fine");
    }
}
