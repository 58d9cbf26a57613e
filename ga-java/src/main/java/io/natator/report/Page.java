package io.natator.report;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Base64;
import java.util.List;
import java.util.stream.Collectors;

/** A page of text, tables and pictures that is written both as Markdown and as one HTML file with all pictures in it. */
public final class Page {

    private static final String HTML = """
            <!DOCTYPE html>
            <html lang="en"><head><meta charset="utf-8"><title>%s</title>
            <style>body{font:16px/1.45 sans-serif;max-width:64em;margin:2em auto;padding:0 1em}
            table{border-collapse:collapse;margin:1em 0;font-size:14px}td,th{border:1px solid #bbb;padding:.2em .5em}
            td:not(:first-child){text-align:right}img{max-width:100%%}pre{background:#f4f4f4;padding:.6em;overflow:auto}
            </style></head><body>
            %s</body></html>
            """;

    private final Path folder;
    private final String title;
    private final List<Part> parts = new ArrayList<>();

    /** A part of the page in both forms. */
    private record Part(String markdown, String html) {
    }

    /**
     * An empty page.
     *
     * @param folder where it goes; pictures are in it or below
     */
    public Page(Path folder, String title) {
        this.folder = folder;
        this.title = title;
        heading(1, title);
    }

    /** Adds a heading, 1 being that of the page. */
    public Page heading(int level, String text) {
        parts.add(new Part("#".repeat(level) + " " + text, "<h" + level + ">" + escaped(text) + "</h" + level + ">"));
        return this;
    }

    /** Adds a paragraph; {@code `code`} is set as such. */
    public Page text(String text) {
        parts.add(new Part(text, "<p>" + marked(text) + "</p>"));
        return this;
    }

    /** Adds a list. */
    public Page list(List<String> items) {
        parts.add(new Part(items.stream().map(item -> "- " + item).collect(Collectors.joining("\n")),
                items.stream().map(item -> "<li>" + marked(item) + "</li>").collect(Collectors.joining("\n", "<ul>", "</ul>"))));
        return this;
    }

    /**
     * Adds a table.
     *
     * @param columns headings; the first column is text, the others are numbers
     * @param rows    one field per column each
     */
    public Page table(List<String> columns, List<List<String>> rows) {
        String markdown = "| " + String.join(" | ", columns) + " |\n| ---" + " | ---:".repeat(columns.size() - 1) + " |"
                + rows.stream().map(row -> "\n| " + String.join(" | ", row) + " |").collect(Collectors.joining());
        String html = "<table><tr>" + cells("th", columns) + "</tr>"
                + rows.stream().map(row -> "\n<tr>" + cells("td", row) + "</tr>").collect(Collectors.joining()) + "</table>";
        parts.add(new Part(markdown, html));
        return this;
    }

    private static String cells(String tag, List<String> fields) {
        return fields.stream().map(field -> "<" + tag + ">" + marked(field) + "</" + tag + ">").collect(Collectors.joining());
    }

    /**
     * Adds a picture; what is not there is left out.
     *
     * @param png   its PNG file; an SVG of the same name lies beside it
     * @param about what it shows
     */
    public Page picture(Path png, String about) {
        Path svg = png.resolveSibling(png.getFileName().toString().replaceFirst("\\.png$", ".svg"));
        if (!Files.exists(png) || !Files.exists(svg)) {
            return this;
        }
        String name = folder.relativize(png).toString().replace('\\', '/');
        try {
            String data = Base64.getEncoder().encodeToString(Files.readAllBytes(svg));
            parts.add(new Part("![" + about + "](" + name + ")",
                    "<p><img alt=\"" + escaped(about) + "\" src=\"data:image/svg+xml;base64," + data + "\"></p>"));
            return this;
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + svg + ": " + e.getMessage(), e);
        }
    }

    /** Adds commands or other text of fixed width. */
    public Page code(String text) {
        parts.add(new Part("```\n" + text.strip() + "\n```", "<pre>" + escaped(text.strip()) + "</pre>"));
        return this;
    }

    /**
     * Writes both files.
     *
     * @param name of the Markdown file; the HTML file is {@code report.html}
     * @return the Markdown file
     */
    public Path write(String name) throws IOException {
        Files.createDirectories(folder);
        Files.writeString(folder.resolve("report.html"), HTML.formatted(escaped(title),
                parts.stream().map(Part::html).collect(Collectors.joining("\n"))));
        return Files.writeString(folder.resolve(name),
                parts.stream().map(Part::markdown).collect(Collectors.joining("\n\n")) + "\n");
    }

    private static String escaped(String text) {
        return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace("\"", "&quot;");
    }

    private static String marked(String text) {
        return escaped(text).replaceAll("`([^`]*)`", "<code>$1</code>").replaceAll("\\*\\*([^*]*)\\*\\*", "<b>$1</b>");
    }
}
