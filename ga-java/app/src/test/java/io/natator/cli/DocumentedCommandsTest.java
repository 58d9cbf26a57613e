package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatCode;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

/** Commands in documents, and in the scripts that measure results, are ones that the programs take: names, options and their values. */
class DocumentedCommandsTest {

    private static final Path ROOT = Path.of("../..").toAbsolutePath().normalize();
    private static final Path SIMULATOR = Path
            .of(System.getProperty("natator.simulator", ROOT + "/build/release/bin/natator-sim"));
    private static final Pattern NATATOR = Pattern
            .compile("^(?:\\$ )?(?:build/release/bin/natator|natator|java -jar ga-java/target/natator\\.jar"
                    + "|\\S*spark-submit .*natator-spark\\.jar) (.*)$");
    private static final Pattern SIMULATES = Pattern
            .compile("^(?:\\$ )?(?:build/release/bin/)?natator-sim ([a-z]+)(.*)$");
    private static final Pattern OPTION = Pattern.compile("(?<= )--[a-z-]+");
    private static final Pattern WORD = Pattern.compile("'([^']*)'|\"([^\"]*)\"|([^\\s'\"]+)");

    @TempDir
    private Path folder;

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

    private static List<Shown> matching(Pattern pattern) throws IOException {
        return documents().flatMap(file -> code(file).stream())
                .filter(shown -> pattern.matcher(shown.line).matches() && !shown.line.matches(".*[\\[…].*")).distinct()
                .toList();
    }

    static List<Shown> commands() throws IOException {
        return matching(NATATOR);
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

    @Test
    void aCommandOfTheSimulatorHasItsOptions() throws IOException, InterruptedException {
        Map<String, String> help = new HashMap<>();
        List<Shown> all = matching(SIMULATES);
        assertThat(all).hasSizeGreaterThan(15);
        for (Shown shown : all) {
            Matcher matcher = SIMULATES.matcher(shown.line.replaceAll("'[^']*'", "TEXT"));
            assertThat(matcher.matches()).isTrue();
            String command = matcher.group(1);
            if (!help.containsKey(command)) {
                help.put(command, helpOf(command));
            }
            Matcher options = OPTION.matcher(matcher.group(2));
            while (options.find()) {
                assertThat(help.get(command)).as(shown.toString()).containsPattern(options.group() + "[ ,\\n]");
            }
        }
    }

    /** What a command says of itself, and each of its own commands. */
    private String helpOf(String command) throws IOException, InterruptedException {
        StringBuilder text = new StringBuilder(run(command, "--help"));
        Matcher below = Pattern.compile("(?m)^  ([a-z]+) {2,}\\S")
                .matcher(text.substring(Math.max(0, text.indexOf("Subcommands:"))));
        List<String> commands = new ArrayList<>();
        while (text.indexOf("Subcommands:") >= 0 && below.find()) {
            commands.add(below.group(1));
        }
        for (String each : commands) {
            text.append(run(command, each, "--help"));
        }
        return text.toString();
    }

    private String run(String... arguments) throws IOException, InterruptedException {
        List<String> command = new ArrayList<>(List.of(SIMULATOR.toString()));
        command.addAll(List.of(arguments));
        Path output = folder.resolve("output");
        int status = new ProcessBuilder(command).redirectOutput(output.toFile()).redirectErrorStream(true).start()
                .waitFor();
        String said = Files.readString(output);
        assertThat(status).as(String.join(" ", arguments) + ": " + said).isZero();
        return said;
    }
}
