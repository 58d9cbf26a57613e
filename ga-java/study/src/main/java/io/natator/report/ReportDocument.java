package io.natator.report;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Base64;
import java.util.HashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.function.Consumer;
import java.util.stream.Collectors;
import org.commonmark.Extension;
import org.commonmark.ext.gfm.tables.TablesExtension;
import org.commonmark.node.Heading;
import org.commonmark.node.Image;
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
            <meta name="viewport" content="width=device-width">
            <style>:root{color-scheme:light dark;--line:#bbb;--code:#f4f4f4;--holds:#1a7f37;--fails:#c62828;--unknown:#6e6e6e}
            @media(prefers-color-scheme:dark){:root{--line:#555;--code:#262626;--holds:#57c47a;--fails:#ff8a80;--unknown:#a8a8a8}
            img.chart{filter:invert(.9) hue-rotate(180deg)}img.portrait{filter:brightness(.85)}}
            body{font:16px/1.45 sans-serif;max-width:64em;margin:1em auto;padding:0 1em;overflow-wrap:anywhere}
            table{border-collapse:collapse;margin:1em 0;font-size:14px;display:block;overflow-x:auto}
            td,th{border:1px solid var(--line);padding:.2em .5em;overflow-wrap:normal}
            td.holds{color:var(--holds)}td.fails{color:var(--fails)}td.unknown{color:var(--unknown)}
            img{max-width:100%%;background:#fff;vertical-align:top}p.figure{overflow-x:auto}img.portrait{max-height:18em}h1{margin:.5em 0}
            blockquote{margin:1em 0;padding:0 1em;border-left:3px solid var(--line)}
            @media(max-width:42em){img.chart{max-width:none;width:40em}}
            pre{background:var(--code);padding:.6em;overflow:auto}
            summary{cursor:pointer;margin:1em 0}
            </style></head><body>
            %s</body></html>
            """;
    private static final String CONTENTS = "\0";
    /** Words that a table's field says an outcome by, and the class that colours it. */
    private static final Map<String, String> OUTCOMES = Map.of("✔", "holds", "✘", "fails", "–", "unknown");
    private static final List<Extension> TABLES = List.of(TablesExtension.create());

    private final Path folder;
    private final String title;
    private final List<String> parts = new ArrayList<>();
    private final List<String> sections = new ArrayList<>();
    private final Set<String> portraits = new HashSet<>();

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
        if (level == 2) {
            sections.add(text);
        }
        return add("#".repeat(level) + " " + text);
    }

    /** Adds links to all headings of the second level, also to those that follow. */
    public ReportDocument contents() {
        return add(CONTENTS);
    }

    /**
     * Adds what can be unfolded by a click.
     *
     * @param summary what it is, shown always
     * @param content adds what is shown then
     */
    public ReportDocument folded(String summary, Consumer<ReportDocument> content) {
        add("<details><summary>" + summary + "</summary>");
        content.accept(this);
        return add("</details>");
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
     * @param columns headings; the first column is text, the others are numbers. What begins with ✔, ✘ or – is coloured
     * @param rows    one field per column each
     */
    public ReportDocument table(List<String> columns, List<List<String>> rows) {
        return table(columns, " | ---:", rows);
    }

    /** Adds a table of text alone, see {@link #table}. */
    public ReportDocument words(List<String> columns, List<List<String>> rows) {
        return table(columns, " | ---", rows);
    }

    private ReportDocument table(List<String> columns, String alignment, List<List<String>> rows) {
        return add(row(columns) + "\n| ---" + alignment.repeat(columns.size() - 1) + " |"
                + rows.stream().map(fields -> "\n" + row(fields)).collect(Collectors.joining()));
    }

    private static String row(List<String> fields) {
        return "| " + String.join(" | ", fields) + " |";
    }

    /**
     * Adds a chart; one that is not there is left out. Where a reader prefers dark pages, its colours are turned round.
     *
     * @param png   its file
     * @param about what it shows
     */
    public ReportDocument picture(Path png, String about) {
        return Files.exists(png) ? add("![" + about + "](" + name(png) + ")") : this;
    }

    /** Adds a picture whose colours are those of what it shows, see {@link #picture}. */
    public ReportDocument portrait(Path png, String about) {
        portraits.add(name(png));
        return picture(png, about);
    }

    private String name(Path png) {
        return folder.relativize(png).toString().replace('\\', '/');
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
        String contents = sections.stream().map(section -> "[" + section + "](#" + anchor(section) + ")")
                .collect(Collectors.joining(" · "));
        String markdown = String.join("\n\n", parts).replace(CONTENTS, contents) + "\n";
        Files.createDirectories(folder);
        Files.writeString(folder.resolve("report.html"), HTML.formatted(HtmlRenderer.builder().build().render(new Text(title)), rendered(markdown)));
        return Files.writeString(folder.resolve(name), markdown);
    }

    private String rendered(String markdown) {
        Node document = Parser.builder().extensions(TABLES).build().parse(markdown);
        return HtmlRenderer.builder().extensions(TABLES)
                .attributeProviderFactory(context -> (node, tag, attributes) -> {
                    if (tag.equals("p") && node.getFirstChild() instanceof Image && node.getFirstChild() == node.getLastChild()) {
                        attributes.put("class", "figure");
                    } else if (tag.equals("img")) {
                        attributes.put("class", portraits.contains(attributes.get("src")) ? "portrait" : "chart");
                        attributes.computeIfPresent("src", (key, file) -> embedded(folder.resolve(file)));
                    } else if (node instanceof Heading) {
                        attributes.put("id", anchor(textOf(node)));
                    } else if (tag.equals("td")) {
                        OUTCOMES.forEach((sign, name) -> {
                            if (textOf(node).startsWith(sign + " ")) {
                                attributes.put("class", name);
                            }
                        });
                    }
                }).build().render(document);
    }

    private static String textOf(Node node) {
        StringBuilder text = new StringBuilder();
        for (Node child = node.getFirstChild(); child != null; child = child.getNext()) {
            text.append(child instanceof Text literal ? literal.getLiteral() : textOf(child));
        }
        return text.toString();
    }

    /** What a heading is linked to by, as where Markdown is shown on the web. */
    private static String anchor(String heading) {
        return heading.toLowerCase(Locale.ROOT).replaceAll("[^\\p{L}\\p{N} _-]", "").replace(' ', '-');
    }

    private static String embedded(Path png) {
        try {
            return "data:image/png;base64," + Base64.getEncoder().encodeToString(Files.readAllBytes(png));
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + png + ": " + e.getMessage(), e);
        }
    }
}
