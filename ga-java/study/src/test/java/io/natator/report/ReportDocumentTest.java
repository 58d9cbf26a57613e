package io.natator.report;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.plot.Picture;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.knowm.xchart.XYChart;

class ReportDocumentTest {

    @TempDir
    private Path folder;

    @Test
    void writesTheSamePageInBothForms() throws IOException {
        XYChart chart = Charts.lines("a chart", "x", "y");
        Charts.add(chart, "line", new double[] {0, 1}, new double[] {0, 1}, 0, 1f);
        Path png = Picture.save(chart, folder.resolve("plots/chart"));

        Path page = new ReportDocument(folder, "Title & more").text("Some **bold** `code`.").picture(png, "a line")
                .picture(folder.resolve("missing.png"), "not there")
                .table(List.of("what", "value"), List.of(List.of("a < b", "1"))).list(List.of("one"))
                .code("run it\n").write("README.md");

        assertThat(Files.readString(page)).isEqualTo("""
                # Title & more

                Some **bold** `code`.

                ![a line](plots/chart.png)

                | what | value |
                | --- | ---: |
                | a < b | 1 |

                - one

                ```
                run it
                ```
                """);
        String html = Files.readString(folder.resolve("report.html"));
        assertThat(html).contains("<title>Title &amp; more</title>", "<h1>Title &amp; more</h1>",
                "<strong>bold</strong> <code>code</code>", "<td>a &lt; b</td>",
                "<td align=\"right\">1</td>", "src=\"data:image/png;base64,", "<li>one</li>", "<pre><code>run it")
                .doesNotContain("not there", "src=\"plots");
    }
}
