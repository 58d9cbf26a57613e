package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatCode;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

/** Commands in documents, and in the scripts that measure results, are ones that the programs take: names, options and their values. */
class DocumentedCommandsTest {

    private static final Path ROOT = Path.of("../..").toAbsolutePath().normalize();
    private static final Pattern NATATOR = Pattern
            .compile("^(?:\\$ )?(?:build/release/bin/natator|natator|java -jar ga-java/target/natator\\.jar"
                    + "|\\S*spark-submit .*natator-spark\\.jar) (.*)$");
    private static final Pattern WORD = Pattern.compile("'([^']*)'|\"([^\"]*)\"|([^\\s'\"]+)");

    /** A command and where it stands. */
    record Shown(String file, String line) {
        @Override
        public String toString() {
            return file + ": " + line;
        }
    }

    private static Stream<Path> documents() throws IOException {
        List<Path> files = new ArrayList<>(List.of(ROOT.resolve("README.md"), ROOT.resolve("CONTRIBUTING.md")));
        for (String within : List.of("sim-native/docs", "sim-native/protocol", "sim-native/python", "ga-java/docs",
                "results")) {
            try (Stream<Path> all = Files.walk(ROOT.resolve(within))) {
                all.filter(file -> file.toString().endsWith(".md") || isScript(file)).forEach(files::add);
            }
        }
        return files.stream();
    }

    private static boolean isScript(Path file) {
        return file.getFileName().toString().matches("measure.*\\.sh");
    }

    /** Lines of code, continued ones joined, without comments. */
    private static List<Shown> code(Path file) {
        List<Shown> lines = new ArrayList<>();
        boolean fenced = isScript(file);
        try {
            String text = Files.readString(file, StandardCharsets.UTF_8).replaceAll("\\\\\\n\\s*", "");
            for (String line : text.split("\n")) {
                if (line.startsWith("```")) {
                    fenced = !fenced;
                } else if (fenced || line.startsWith("    ")) {
                    lines.add(new Shown(ROOT.relativize(file).toString(), line.strip().replaceAll(" +# .*$", "")));
                }
            }
        } catch (IOException e) {
            throw new IllegalStateException(e);
        }
        return lines;
    }

    static List<Shown> commands() throws IOException {
        return documents().flatMap(file -> code(file).stream())
                .filter(shown -> NATATOR.matcher(shown.line).matches() && !shown.line.matches(".*[\\[…].*")).distinct()
                .toList();
    }

    private static List<String> words(String command) {
        List<String> words = new ArrayList<>();
        Matcher matcher = WORD.matcher(command.replaceAll(" [|&>].*$", ""));
        while (matcher.find()) {
            words.add(matcher.group(1) != null ? matcher.group(1)
                    : matcher.group(2) != null ? matcher.group(2) : matcher.group(3));
        }
        return words;
    }

    @ParameterizedTest(name = "{0}")
    @MethodSource("commands")
    void aCommandOfNatatorIsUnderstood(Shown shown) {
        Matcher matcher = NATATOR.matcher(shown.line);
        assertThat(matcher.matches()).isTrue();

        assertThatCode(() -> Main.commandLine().parseArgs(words(matcher.group(1)).toArray(String[]::new)))
                .doesNotThrowAnyException();
    }
}
