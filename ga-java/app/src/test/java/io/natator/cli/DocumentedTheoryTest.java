package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;
import java.util.TreeMap;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;

/** The numbers that theory.md gives are those of the headers that it links to, and the files that it links to are there. */
class DocumentedTheoryTest {

    private static final Path PAGE = Path.of("../../sim-native/docs/theory.md").toAbsolutePath().normalize();
    private static final Path PHYSICS = PAGE.resolve("../../src/physics").normalize();
    private static final Pattern CELLS = Pattern.compile("\\| `([a-z_]+)` \\| ([0-9.e-]+) (?=\\|)");
    private static final Pattern CONSTANT = Pattern.compile("\\b([a-z_]{4,}) = ([0-9.e-]+)[,;]");
    private static final Pattern LINK = Pattern.compile("\\]\\(([^)#:]+)(?:#[^)]*)?\\)");

    private static Map<String, Double> numbers(Pattern pattern, String text) {
        Map<String, Double> numbers = new TreeMap<>();
        Matcher matcher = pattern.matcher(text);
        while (matcher.find()) {
            numbers.put(matcher.group(1), Double.valueOf(matcher.group(2)));
        }
        return numbers;
    }

    @Test
    void theNumbersOfTheMethodAreThoseOfTheSource() throws IOException {
        Map<String, Double> told = numbers(CELLS, Files.readString(PAGE));
        Map<String, Double> used = numbers(CONSTANT, Files.readString(PHYSICS.resolve("constants.h")));
        Map<String, Double> method = numbers(CONSTANT, Files.readString(PHYSICS.resolve("dfsph.h")));
        used.putAll(method);

        assertThat(told).isNotEmpty().allSatisfy((name, value) -> assertThat(used).containsEntry(name, value));
        assertThat(told.keySet()).as("the numbers of dfsph.h").containsAll(method.keySet());
    }

    @Test
    void whatItLinksToIsThere() throws IOException {
        Matcher link = LINK.matcher(Files.readString(PAGE));
        int links = 0;
        for (; link.find(); ++links) {
            assertThat(PAGE.resolveSibling(link.group(1))).exists();
        }
        assertThat(links).isGreaterThan(20);
    }
}
