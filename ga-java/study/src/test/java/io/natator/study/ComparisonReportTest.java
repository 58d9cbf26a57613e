package io.natator.study;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class ComparisonReportTest {

    private static final Variant VARIANT = StudyFixtures.variant("v", "{}", 1.0, 1.2);
    private static final List<Comparison> COMPARISONS = List.of(
            Comparison.of(VARIANT, Interval.TWO_SECONDS, List.of(0.5), List.of(1.0)),
            Comparison.of(VARIANT, Interval.FOUR_SECONDS, List.of(1.3, 1.5), List.of(1.0)));

    @TempDir
    private Path directory;

    @Test
    void aVariantIsOneRow() {
        assertThat(ComparisonReport.markdown(COMPARISONS, "command", "file"))
                .contains("| v | about v | 0.5500 ± 0.0707 (2) | 0.5000 (1) | 1.0000 | – "
                        + "| 1.1000 ± 0.1414 (2) | 1.4000 ± 0.1414 (2) | 1.0000 | +1.5 |\n")
                .contains("in fluid: 2 comparisons; |Δ| ≤ 1 in 0, ≤ 2 in 1")
                .contains("24.7 % of the speeds, as stated 37.5 %; the run as stated is nearer than the mean in 1");
    }

    @Test
    void thePictureIsDrawn() throws IOException {
        ComparisonChart.draw("title", COMPARISONS, directory, "picture");
        assertThat(directory.resolve("picture.png")).isNotEmptyFile();
    }
}
