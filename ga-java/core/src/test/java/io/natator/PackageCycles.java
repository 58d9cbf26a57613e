package io.natator;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.regex.Pattern;
import java.util.stream.Stream;

/** Which packages of a module need each other, by the names that their sources import or write out; comments do not count. */
public final class PackageCycles {

    private static final Pattern COMMENT = Pattern.compile("/\\*.*?\\*/|//[^\n]*", Pattern.DOTALL);
    private static final Pattern NAME = Pattern.compile("\\b(io\\.natator(?:\\.[a-z]\\w*)*)\\.[A-Z]\\w*");

    private PackageCycles() {
    }

    /**
     * Every step from a package to another from which a way leads back, as {@code io.natator.a -> io.natator.b: A, B} with the classes that
     * take it; empty without a cycle.
     *
     * @param sources folder of Java sources, such as {@code src/main/java}
     */
    public static List<String> in(Path sources) throws IOException {
        Map<String, Map<String, Set<String>>> uses = new TreeMap<>();
        try (Stream<Path> files = Files.walk(sources)) {
            files.filter(file -> file.toString().endsWith(".java")).forEach(file -> add(sources, file, uses));
        }
        return uses.entrySet().stream().flatMap(from -> from.getValue().entrySet().stream()
                .filter(to -> reachable(to.getKey(), uses).contains(from.getKey()))
                .map(to -> from.getKey() + " -> " + to.getKey() + ": " + String.join(", ", to.getValue()))).toList();
    }

    private static void add(Path sources, Path file, Map<String, Map<String, Set<String>>> uses) {
        String own = sources.relativize(file.getParent()).toString().replace('/', '.');
        try {
            String code = COMMENT.matcher(Files.readString(file)).replaceAll(" ");
            NAME.matcher(code).results().map(name -> name.group(1)).filter(used -> !used.equals(own))
                    .forEach(used -> uses.computeIfAbsent(own, any -> new TreeMap<>())
                            .computeIfAbsent(used, any -> new TreeSet<>())
                            .add(file.getFileName().toString().replace(".java", "")));
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private static Set<String> reachable(String from, Map<String, Map<String, Set<String>>> uses) {
        Set<String> found = new TreeSet<>(Set.of(from));
        Deque<String> next = new ArrayDeque<>(found);
        while (!next.isEmpty()) {
            uses.getOrDefault(next.pop(), Map.of()).keySet().stream().filter(found::add).forEach(next::push);
        }
        return found;
    }
}
