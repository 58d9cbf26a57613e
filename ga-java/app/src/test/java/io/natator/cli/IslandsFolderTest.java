package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Commands that take a run folder take one of islands, too, and mean the winner's; with the real simulator in a small tank. */
class IslandsFolderTest {

    private static final String SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize().toString();

    @TempDir
    private static Path runs;
    private static Path islands;
    private static Path winner;
    private static Path other;

    @TempDir
    private Path folder;
    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    /** By this seed the second island wins: not the one that is first anyway. */
    @BeforeAll
    static void evolve() {
        islands = runs.resolve("ring");
        Commands.natator("evolve", "--simulator-path", SIMULATOR, "--scene", "bench/small-tank", "--islands", "2", "--migrate-every",
                "1", "--migrants", "1", "--population", "3", "--generations", "2", "--starts", "1", "--duration", "0.05", "--seed", "1",
                "--output-dir", islands.toString());
        List<Path> worstFirst = Stream.of("island-1", "island-2").map(islands::resolve)
                .sorted(Comparator.comparing(IslandsFolderTest::distance)).toList();
        other = worstFirst.get(0);
        winner = worstFirst.get(1);
    }

    private int status(String... arguments) {
        return Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true)).execute(arguments);
    }

    private String natator(String... arguments) {
        assertThat(status(arguments)).as(err.toString()).isZero();
        return out.toString();
    }

    /** A command that the real simulator swims for. */
    private String swim(String... arguments) {
        List<String> all = new ArrayList<>(List.of(arguments));
        all.addAll(1, List.of("--simulator-path", SIMULATOR));
        return natator(all.toArray(String[]::new));
    }

    private static double distance(Path run) {
        return Json.read(run.resolve("best.json"), JsonNode.class, "best").get("distance").doubleValue();
    }

    @Test
    void showTellsOfTheWinnersRun() {
        String ofAll = natator("show", islands.toString());
        out.getBuffer().setLength(0);
        String ofWinner = natator("show", winner.toString());

        assertThat(ofAll).endsWith(ofWinner).hasSizeGreaterThan(ofWinner.length());
    }

    @Test
    void anIslandThatIsNotFinishedGoesOnWithTheOthers() throws IOException {
        Path config = other.resolve("config.json");
        String settings = Files.readString(config);
        Files.writeString(config, settings.replace("\"generations\" : 2", "\"generations\" : 3"));
        String told = natator("show", other.toString());
        Files.writeString(config, settings);

        assertThat(told).contains("not finished, 0 evaluations of the next; continue by: natator resume " + islands + "\n");
    }

    @Test
    void nobodyWinsWithoutAGait() throws IOException {
        for (String name : List.of("islands.json", "island-1/config.json", "island-2/config.json")) {
            Files.createDirectories(folder.resolve(name).getParent());
            Files.copy(islands.resolve(name), folder.resolve(name));
        }

        assertThat(natator("show", folder.toString())).contains("  1       1       -  ", "no generation finished, 0 evaluations of the first")
                .doesNotContain("winner");
    }

    @Test
    void checkAndReportAreInTheWinnersFolder() {
        assertThat(swim("check", "--starts", "2", islands.toString())).contains("\nverdict: ");
        swim("report", islands.toString());

        assertThat(natator("show", winner.toString())).contains("  checked     ");
        assertThat(winner.resolve("report/README.md")).content().startsWith("# bench/small-tank, seed " + (winner.endsWith("island-1") ? 1 : 2) + "\n");
        assertThat(winner.resolve("report/swimmer.png")).isNotEmptyFile();
        assertThat(other.resolve("report")).doesNotExist();
        assertThat(islands.resolve("report")).doesNotExist();
    }

    @Test
    void compareTakesTheWinner() {
        String told = natator("compare", "--starts", "0", islands.toString(), other.toString());

        assertThat(told).contains("1  " + winner + ": bench/small-tank", "2  " + other + ": ");
    }

    @Test
    void compareRefusesTheSameRunTwice() throws IOException {
        Path link = Files.createSymbolicLink(folder.resolve("link"), winner);
        for (List<Path> twice : List.of(List.of(other, other), List.of(islands, other, winner), List.of(winner, link))) {
            err.getBuffer().setLength(0);
            List<String> arguments = new ArrayList<>(List.of("compare", "--starts", "0"));
            twice.forEach(one -> arguments.add(one.toString()));

            assertThat(status(arguments.toArray(String[]::new))).isEqualTo(2);
            Path named = twice.contains(other) && twice.size() == 2 ? other : winner;
            assertThat(err.toString()).isEqualTo("natator compare: RUN has " + named + " twice; expected each once\n");
        }
        assertThat(out.toString()).isEmpty();
    }

    @Test
    void showNamesWhatIsDamagedOfAnyIsland() throws IOException {
        for (Path island : List.of(other, winner)) {
            for (String name : List.of("evaluations.jsonl", "migrants.jsonl", "config.json")) {
                if (island.equals(winner) && name.equals("config.json")) {
                    continue;  // then another one is the winner
                }
                byte[] whole = Files.readAllBytes(island.resolve(name));
                err.getBuffer().setLength(0);
                Files.delete(island.resolve(name));
                natator("show", islands.toString());
                Files.write(island.resolve(name), whole);

                assertThat(err.toString()).startsWith("natator show: warning: " + island + " is damaged: ").contains(name).hasLineCount(1);
            }
        }
    }

    @Test
    void ofAFolderThatIsRefusedNothingIsShown() throws IOException {
        Path damaged = copyOf(islands);
        Files.writeString(damaged.resolve("island-2/checkpoint.json"), "{");

        assertThat(status("show", damaged.toString())).isEqualTo(2);
        assertThat(err.toString()).startsWith("natator show: checkpoint " + damaged.resolve("island-2/checkpoint.json")).hasLineCount(1);
        assertThat(out.toString()).isEmpty();
    }

    @Test
    void whatCannotBeGoneOnWithChangesNoBackend() throws IOException {
        Path unfinished = copyOf(islands);
        Files.delete(unfinished.resolve("island-1/checkpoint.json"));
        for (Path run : List.of(unfinished, unfinished.resolve("island-1"))) {
            err.getBuffer().setLength(0);
            Path told = run.resolve(run.equals(unfinished) ? "islands.json" : "config.json");
            String before = Files.readString(told);

            assertThat(status("resume", "--simulator-path", SIMULATOR, "--backend", "auto", "--workers", "0", run.toString())).isEqualTo(2);

            assertThat(err.toString()).hasLineCount(1).startsWith(run.equals(unfinished)
                    ? "natator resume: workers is 0; expected a whole number from 1 to 1024\n"
                    : "natator resume: " + run + " is one of 2 islands, which go on together");
            assertThat(told).hasContent(before);
        }
    }

    @Test
    void finishedIslandsKeepTheirBackend() throws IOException {
        String before = Files.readString(islands.resolve("islands.json"));

        swim("resume", "--backend", "auto", islands.toString());

        assertThat(err.toString()).startsWith("finished on backend cpu; nothing is left to compute on auto\n");
        assertThat(islands.resolve("islands.json")).hasContent(before);
    }

    private Path copyOf(Path directory) throws IOException {
        Path copy = folder.resolve("copy");
        try (Stream<Path> all = Files.walk(directory)) {
            for (Path one : all.toList()) {
                Files.copy(one, copy.resolve(directory.relativize(one)));
            }
        }
        return copy;
    }

    /** Two pictures of a moment in which two gaits have bent the body differently. */
    @Test
    void pictureDrawsTheWinner() throws IOException {
        List<byte[]> pictures = new ArrayList<>();
        for (Path run : List.of(islands, winner, other)) {
            Path file = folder.resolve("picture-" + pictures.size() + ".png");
            swim("picture", run.toString(), "--size", "320x200", "-o", file.toString());
            pictures.add(Files.readAllBytes(file));
        }

        assertThat(pictures.get(0)).isEqualTo(pictures.get(1)).isNotEqualTo(pictures.get(2));
    }

    @Test
    void pageAndExportSwimTheWinner() throws IOException {
        List<String> pages = new ArrayList<>();
        List<String> tables = new ArrayList<>();
        for (Path run : List.of(islands, winner, other)) {
            Path page = folder.resolve("page-" + pages.size() + ".html");
            Path export = folder.resolve("export-" + pages.size());
            swim("page", run.toString(), "--no-water", "--output", page.toString());
            swim("export", run.toString(), "--format", "csv", "--no-water", "--output-dir", export.toString());
            pages.add(Files.readString(page));
            try (var files = Files.list(export)) {
                tables.add(Files.readString(files.filter(one -> one.toString().endsWith(".csv")).sorted().findFirst().orElseThrow()));
            }
        }

        assertThat(tables.get(0)).isEqualTo(tables.get(1)).isNotEqualTo(tables.get(2));
        assertThat(pages.get(0)).contains("class=\"swim\"").isEqualTo(pages.get(1)).isNotEqualTo(pages.get(2));
    }
}
