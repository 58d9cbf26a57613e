package io.natator.study.thesis;

import io.natator.config.EvolutionSettings;
import io.natator.config.FileErrors;
import io.natator.config.Json;
import io.natator.file.GeneratedPage;
import io.natator.file.ShellWord;
import io.natator.plot.Drawing;
import io.natator.report.FirstScreen;
import io.natator.report.Recording;
import io.natator.report.ReportDocument;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/** The report: {@code README.md} and {@code report.html}. All that it says of numbers follows from them. */
final class ThesisReport {

    private static final String COMMENTARY = "commentary.md";
    /** Works the page's numbers out anew, without this program. */
    private static final String RECOMPUTE = "recompute.py";
    /** What a person wants said first. */
    private static final String NOTE = "note.md";

    private final Path directory;
    private final StudyResults results;
    private final int asked;
    private final Map<String, Recording> recordings;
    private final String command;

    /**
     * A report.
     *
     * @param asked     how many evolutions there are to be with these seeds
     * @param command   what the study is made by, line by line
     */
    ThesisReport(StudyResults results, int asked, Map<String, Recording> recordings, String command) {
        this.directory = results.directory();
        this.results = results;
        this.asked = asked;
        this.recordings = recordings;
        this.command = command;
    }

    Path write() throws InterruptedException {
        ReportDocument page = new ReportDocument(directory, "The thesis, redone");
        addByHand(page, NOTE);
        ClaimsSection claims = new ClaimsSection(results, recordings);
        addFirstScreen(page, new Answers(results, claims));
        new MethodsSection(results).add(page);
        new WinnersSection(results).add(page);
        claims.add(page);
        new FlexSection(results).add(page);
        page.heading(2, "Which fish").folded("e, and how the bodies lie", new RealismTables(results)::add);
        page.heading(2, "Parameters, activation, two clusters").folded("all tables", new ExperimentTables(results)::add);
        page.heading(2, "Pictures").folded("all pictures", this::addPictures);
        addCommentary(page);
        page.heading(2, "How it was made").list(scale());
        page.text(GeneratedPage.MARK);
        addCommands(page);
        try {
            return page.write(GeneratedPage.NAME);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write the report: " + e.getMessage(), e);
        }
    }

    private void addFirstScreen(ReportDocument page, Answers answers) throws InterruptedException {
        try {
            Drawing.orWarn("pictures of the first screen", () -> drawFirstScreen(page, answers));
        } catch (IOException e) {
            throw new UncheckedIOException("cannot draw: " + FileErrors.reason(directory, e), e);
        }
    }

    private void drawFirstScreen(ReportDocument page, Answers answers) throws IOException, InterruptedException {
        Path swimmer = directory.resolve("figures").resolve("swimmer.png");
        Files.createDirectories(swimmer.getParent());
        Path chart = answers.draw(directory.resolve("figures").resolve("answers"));
        FirstScreen.add(page, answers.sentences(), swimmer, results.portrayed().map(subject -> "creature " + subject.creature()
                + ", evolved in " + subject.water().words()).orElse("the swimmer"), answers.evidence());
        if (chart != null) {
            page.picture(chart, "speeds in water with error bars");
        }
    }

    private List<String> scale() {
        List<String> items = new ArrayList<>();
        List<EvolutionSettings> settings = results.runs().stream().map(EvolvedRun::storedSettings).toList();
        items.add(results.runs().size() + " of " + asked + " evolutions are finished" + (settings.isEmpty() ? "."
                : ", operators " + each(settings.stream().map(one -> Json.name(one.operators()))) + ", on "
                + each(settings.stream().map(one -> one.backend().argument())) + "."));
        items.add(results.measurements().rows().size() + " evaluations in `measurements.jsonl`, by the native program of SHA-256 "
                + each(results.measurements().programs().stream()) + "; " + results.processor().rows().size() + " in `processor.jsonl`, "
                + each(results.processor().programs().stream()) + "; " + results.convergence().size() + " gaits at half the spacing in "
                + "`convergence.jsonl`; " + results.motions().size() + " recorded motions in `motions.jsonl`.");
        return items;
    }

    /** Each value once. */
    private static String each(Stream<?> values) {
        return values.distinct().map(String::valueOf).collect(Collectors.joining(", "));
    }

    private void addPictures(ReportDocument page) {
        try {
            // A Java without fonts still has the tables.
            Drawing.orWarn("pictures", () -> new ThesisFigures(directory, results, recordings).add(page));
        } catch (IOException e) {
            throw new UncheckedIOException("cannot draw: " + FileErrors.reason(directory, e), e);
        }
    }

    /** What a person wrote, marked as such. */
    private void addCommentary(ReportDocument page) {
        if (Files.exists(directory.resolve(COMMENTARY))) {
            page.heading(2, "Discussion and limitations");
            page.text("Written by hand, from `" + COMMENTARY + "`; everything else on this page is computed.");
            addByHand(page, COMMENTARY);
        }
    }

    /** The paragraphs of a file, if it is there. */
    private void addByHand(ReportDocument page, String name) {
        Path file = directory.resolve(name);
        if (!Files.exists(file)) {
            return;
        }
        try {
            for (String paragraph : Files.readString(file).strip().split("\n\\s*\n")) {
                page.text(paragraph.strip());
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + file + ": " + e.getMessage(), e);
        }
    }

    private void addCommands(ReportDocument page) {
        page.code(command);
        page.text("which continues where it was stopped; `--phase evolve` and `measure` do a part of it, `--dry-run` says how long the rest "
                + "takes, and `--phase repeat` runs some of `processor.jsonl` again and compares the bits. `--phase report` builds page and pictures "
                + "anew from the rows, in seconds. " + recomputed() + "Every number above is computed from rows that hold the whole request and "
                + "result: a row's `request`, given to `natator-sim evaluate`, gives its result with the same hash on the same backend and "
                + "instruction set. Evolved gaits are in `finalists.json` of the run folders, with settings and every generation's figures. "
                + "Pictures are drawn from `recordings/`. Sources of the published and of Flex' numbers:");
        page.list(results.data().about());
    }

    private String recomputed() {
        Path file = directory.resolve(RECOMPUTE);
        return Files.exists(file) ? "`python3 " + ShellWord.of(file) + " --entries 0` works the page's numbers out anew without our code. " : "";
    }
}
