package io.natator.replay;

import io.natator.config.Json;
import java.nio.charset.StandardCharsets;
import java.util.Base64;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** A page as one HTML file: its scripts, styles and data are in it. */
final class PageHtml {

    /** Where something is put into the page; in one go, so that what is put there stays as it is. */
    private static final Pattern PART = Pattern.compile("\\{\\{([a-z-]+)}}");

    private PageHtml() {
    }

    /**
     * Fills a page.
     *
     * @param page   its resource, as {@code natator/replay.html}
     * @param script the module that it begins with, as {@code natator/replay.js}
     * @param title  of the page, as text
     * @param parts  what else the page has places for, by name
     */
    static String of(String page, String script, String title, Map<String, String> parts) {
        Map<String, String> all = new LinkedHashMap<>(parts);
        all.put("title", escaped(title));
        all.put("style", PageModules.resource("natator/theme.css") + PageModules.resource("natator/style.css"));
        all.put("modules", packed(Json.line(PageModules.of(script)).getBytes(StandardCharsets.UTF_8)));
        all.put("loader", PageModules.resource("natator/loader.html"));
        return PART.matcher(PageModules.resource(page))
                .replaceAll(part -> Matcher.quoteReplacement(all.get(part.group(1))));
    }

    /** Base64 of zlib, as {@code expanded} of recording.js reads it. */
    static String packed(byte[] content) {
        return base64(Zlib.compressed(content));
    }

    static String base64(byte[] content) {
        return Base64.getEncoder().encodeToString(content);
    }

    static String escaped(String text) {
        return text.replace("&", "&amp;").replace("<", "&lt;").replace("\"", "&quot;");
    }
}
