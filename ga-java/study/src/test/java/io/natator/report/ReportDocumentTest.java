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
        assertThat(html).contains("<title>Title &amp; more</title>", ">Title &amp; more</h1>",
                "<strong>bold</strong> <code>code</code>", "<td>a &lt; b</td>",
                "<td align=\"right\">1</td>", "src=\"data:image/png;base64,", "<li>one</li>", "<pre><code>run it")
                .doesNotContain("not there", "src=\"plots");
    }

    @Test
    void linksToItsSectionsAndTellsOutcomesByWordAndColour() throws IOException {
        Path page = new ReportDocument(folder, "Title").contents().heading(2, "Beside real fish")
                .table(List.of("what", "outcome"), List.of(List.of("way", "✔ holds"), List.of("mirrored", "✘ does not"),
                        List.of("rest", "– not measured"), List.of("loss", "5 %")))
                .heading(2, "All α, in numbers").write("README.md");

        assertThat(Files.readString(page))
                .contains("[Beside real fish](#beside-real-fish) · [All α, in numbers](#all-α-in-numbers)");
        assertThat(Files.readString(folder.resolve("report.html"))).contains("<h2 id=\"beside-real-fish\">",
                "<h2 id=\"all-α-in-numbers\">", "class=\"holds\">✔ holds", "class=\"fails\">✘ does not",
                "class=\"unknown\">– not measured", "<td align=\"right\">5 %");
    }

    /** Charts are on white and have their colours turned round on a dark page; a portrait keeps its own. */
    @Test
    void tellsChartsFromPortraits() throws IOException {
        XYChart chart = Charts.lines("a chart", "x", "y");
        Charts.add(chart, "line", new double[] {0, 1}, new double[] {0, 1}, 0, 1f);
        Path png = Picture.save(chart, folder.resolve("chart"));
        Path swimmer = Files.copy(png, folder.resolve("swimmer.png"));

        new ReportDocument(folder, "Title").portrait(swimmer, "a swimmer").picture(png, "a line").write("README.md");

        assertThat(Files.readString(folder.resolve("report.html"))).containsPattern("<p class=\"figure\"><img [^>]*alt=\"a swimmer\" class=\"portrait\"")
                .containsPattern("alt=\"a line\" class=\"chart\"")
                .contains("@media(prefers-color-scheme:dark)", "img.chart{filter:invert", "@media(max-width:42em)");
    }

    @Test
    void foldsWhatFewWillRead() throws IOException {
        new ReportDocument(folder, "Title")
                .folded("all numbers", page -> page.table(List.of("what", "value"), List.of(List.of("a", "1")))).write("README.md");

        assertThat(Files.readString(folder.resolve("report.html")))
                .containsSubsequence("<details><summary>all numbers</summary>", "<table>", "<td>a</td>", "</details>");
    }
}
