package io.natator.report;

import io.natator.verdict.Measure;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;

/**
 * What every report begins with, so that one screen tells what came out: an answer of a few sentences, links to what follows,
 * a picture of the swimmer, and a table of what the answer rests on.
 */
public final class FirstScreen {

    /** What stands before an outcome, so that it is told by more than its colour. */
    public static final Map<Measure.Outcome, String> SIGNS = Map.of(Measure.Outcome.HOLDS, "✔", Measure.Outcome.FAILS, "✘",
            Measure.Outcome.NOT_MEASURED, "–");

    private FirstScreen() {
    }

    /**
     * What an answer rests on.
     *
     * @param columns headings
     * @param rows    a field per column each; what begins with one of {@link #SIGNS} is coloured
     * @param note    how to read it
     */
    public record Evidence(List<String> columns, List<List<String>> rows, String note) {
    }

    /**
     * Adds it.
     *
     * @param answer   sentences of Markdown, the most important first
     * @param swimmer  PNG file; left out if it is not there
     * @param about    what it shows
     */
    public static void add(ReportDocument page, List<String> answer, Path swimmer, String about, Evidence evidence) {
        page.text(String.join(" ", answer).strip());
        page.contents();
        page.portrait(swimmer, about);
        page.words(evidence.columns(), evidence.rows());
        page.text(evidence.note());
    }
}
