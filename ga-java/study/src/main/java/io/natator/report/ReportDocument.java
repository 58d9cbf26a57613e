package io.natator.report;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Base64;
import java.util.List;
import java.util.stream.Collectors;
import org.commonmark.Extension;
import org.commonmark.ext.gfm.tables.TablesExtension;
import org.commonmark.node.Node;
import org.commonmark.node.Text;
import org.commonmark.parser.Parser;
import org.commonmark.renderer.html.HtmlRenderer;

/**
 * A page of text, tables and pictures, written as Markdown and as one HTML file that holds its pictures. The HTML is
 * rendered from the Markdown.
 */
public final class ReportDocument {

    private static final String HTML = """
            <!DOCTYPE html>
            <html lang="en"><head><meta charset="utf-8"><title>%s</title>
            <style>body{font:16px/1.45 sans-serif;max-width:64em;margin:2em auto;padding:0 1em}
            table{border-collapse:collapse;margin:1em 0;font-size:14px}td,th{border:1px solid #bbb;padding:.2em .5em}
            img{max-width:100%%}pre{background:#f4f4f4;padding:.6em;overflow:auto}
            </style></head><body>
            %s</body></html>
            """;
    private static final List<Extension> TABLES = List.of(TablesExtension.create());

    private final Path folder;
    private final String title;
    private final List<String> parts = new ArrayList<>();

    /**
     * An empty page.
     *
     * @param folder where it goes; pictures are in it or below
     */
    public ReportDocument(Path folder, String title) {
        this.folder = folder;
        this.title = title;
        heading(1, title);
    }

    /** Adds a heading, 1 being that of the page. */
    public ReportDocument heading(int level, String text) {
        return add("#".repeat(level) + " " + text);
    }

    /** Adds a paragraph of Markdown. */
    public ReportDocument text(String text) {
        return add(text);
    }

    /** Adds a list. */
    public ReportDocument list(List<String> items) {
        return add(items.stream().map(item -> "- " + item).collect(Collectors.joining("\n")));
    }

    /**
     * Adds a table.
     *
     * @param columns headings; the first column is text, the others are numbers
     * @param rows    one field per column each
     */
    public ReportDocument table(List<String> columns, List<List<String>> rows) {
        return add(row(columns) + "\n| ---" + " | ---:".repeat(columns.size() - 1) + " |"
                + rows.stream().map(fields -> "\n" + row(fields)).collect(Collectors.joining()));
    }

    private static String row(List<String> fields) {
        return "| " + String.join(" | ", fields) + " |";
    }

    /**
     * Adds a picture; one that is not there is left out.
     *
     * @param png   its file
     * @param about what it shows
     */
    public ReportDocument picture(Path png, String about) {
        return Files.exists(png)
                ? add("![" + about + "](" + folder.relativize(png).toString().replace('\\', '/') + ")") : this;
    }

    /** Adds commands or other text of fixed width. */
    public ReportDocument code(String text) {
        return add("```\n" + text.strip() + "\n```");
    }

    private ReportDocument add(String markdown) {
        parts.add(markdown);
        return this;
    }

    /**
     * Writes both files.
     *
     * @param name of the Markdown file; the HTML file is {@code report.html}
     * @return the Markdown file
     * @throws IOException if a file cannot be written
     */
    public Path write(String name) throws IOException {
        String markdown = String.join("\n\n", parts) + "\n";
        Files.createDirectories(folder);
        Files.writeString(folder.resolve("report.html"), HTML.formatted(HtmlRenderer.builder().build().render(new Text(title)), rendered(markdown)));
        return Files.writeString(folder.resolve(name), markdown);
    }

    private String rendered(String markdown) {
        Node document = Parser.builder().extensions(TABLES).build().parse(markdown);
        return HtmlRenderer.builder().extensions(TABLES)
                .attributeProviderFactory(context -> (node, tag, attributes) -> {
                    if (tag.equals("img")) {
                        attributes.computeIfPresent("src", (key, file) -> embedded(folder.resolve(file)));
                    }
                }).build().render(document);
    }

    private static String embedded(Path png) {
        try {
            return "data:image/png;base64," + Base64.getEncoder().encodeToString(Files.readAllBytes(png));
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + png + ": " + e.getMessage(), e);
        }
    }
}
