package io.natator.replay;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.regex.MatchResult;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** The scripts of a page: one module and all that it imports, out of the jars of this program. */
final class PageModules {

    private static final String WEBJAR = "META-INF/resources/webjars/three/0.181.1/";
    /** Folders of resources by the beginning of a module's name; the first that has it counts. */
    private static final Map<String, String[]> FOLDERS = new LinkedHashMap<>();
    private static final Pattern IMPORT = Pattern
            .compile("(\\bfrom\\s*|\\bimport\\s*)([\"'])(\\./[^\"']+|three(?:/[^\"']+)?)\\2");

    static {
        FOLDERS.put("three/addons/", new String[] {WEBJAR + "examples/jsm/"});
        FOLDERS.put("three/", new String[] {WEBJAR + "build/"});
        FOLDERS.put("natator/", new String[] {"io/natator/replay/", "io/natator/view/app/"});
    }

    private PageModules() {
    }

    /**
     * Gathers modules. A relative import in them is replaced by the name that it has here.
     *
     * @param first for example {@code natator/replay.js}
     * @return text by name
     * @throws IllegalStateException if one is missing
     */
    static Map<String, String> of(String first) {
        Map<String, String> modules = new LinkedHashMap<>();
        Deque<String> wanted = new ArrayDeque<>();
        wanted.add(first);
        while (!wanted.isEmpty()) {
            String name = wanted.remove();
            if (!modules.containsKey(name)) {
                Matcher imports = IMPORT.matcher(text(name));
                modules.put(name, imports.replaceAll(found -> {
                    String imported = absolute(name, found.group(3));
                    wanted.add(imported);
                    return Matcher.quoteReplacement(rewritten(found, imported));
                }));
            }
        }
        return modules;
    }

    private static String rewritten(MatchResult found, String name) {
        return found.group(1) + found.group(2) + name + found.group(2);
    }

    /** The name of what a module imports; {@code three} itself counts as lying in the folder of its parts. */
    private static String absolute(String importing, String imported) {
        if (!imported.startsWith("./")) {
            return imported;
        }
        String folder = importing.contains("/") ? importing.substring(0, importing.lastIndexOf('/') + 1)
                : importing + "/";
        return folder + imported.substring(2);
    }

    private static String text(String name) {
        return resource(name.equals("three") ? "three/three.module.min.js" : name);
    }

    /** A part of the page by its name: a module or a style sheet. */
    static String resource(String name) {
        String beginning = FOLDERS.keySet().stream().filter(name::startsWith).findFirst()
                .orElseThrow(() -> new IllegalStateException("no part of the page is called " + name));
        for (String folder : FOLDERS.get(beginning)) {
            try (InputStream in = PageModules.class.getClassLoader()
                    .getResourceAsStream(folder + name.substring(beginning.length()))) {
                if (in != null) {
                    return new String(in.readAllBytes(), StandardCharsets.UTF_8);
                }
            } catch (IOException e) {
                throw new UncheckedIOException("cannot read " + name + ": " + e.getMessage(), e);
            }
        }
        throw new IllegalStateException("this program lacks a part of the page: " + name);
    }
}
