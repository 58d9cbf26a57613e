package io.natator.view;

import io.javalin.http.Context;
import io.javalin.http.NotFoundResponse;
import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.util.Map;
import java.util.regex.Pattern;

/**
 * Parts of the page, out of the jars of this program. The folders of some jars are not listed in them, so that what serves
 * folders does not find them.
 *
 * @param folder of the jars; with the folders in it
 */
record JarFiles(String folder) {

    /**
     * Words between single slashes: no way out of the folder. Nothing is tried twice (possessive quantifiers), so that a long
     * name takes no stack.
     */
    private static final Pattern NAME = Pattern
            .compile("\\w[\\w-]*+(?:\\.[\\w-]++)*+(?:/\\w[\\w-]*+(?:\\.[\\w-]++)*+)*+");
    private static final Map<String, String> TYPES = Map.of("js", "text/javascript;charset=utf-8",
            "css", "text/css;charset=utf-8", "svg", "image/svg+xml", "png", "image/png", "json", "application/json");

    /** Answers with the file that the request's {@code name} names. */
    void answer(Context request) {
        String name = request.pathParam("name");
        String type = TYPES.get(name.substring(name.lastIndexOf('.') + 1));
        byte[] content = type == null || !NAME.matcher(name).matches() ? null : read(name);
        if (content == null) {
            throw new NotFoundResponse("no such file");
        }
        request.contentType(type).result(content);
    }

    /** A file as text. */
    String text(String name) {
        return new String(read(name), StandardCharsets.UTF_8);
    }

    /** A file's content, or null if there is none. */
    private byte[] read(String name) {
        try (InputStream in = JarFiles.class.getClassLoader().getResourceAsStream(folder + "/" + name)) {
            return in == null ? null : in.readAllBytes();
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + name + ": " + e.getMessage(), e);
        }
    }
}
