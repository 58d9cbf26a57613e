package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** The page of {@code natator report} from its first line to its last, of a winner that does not swim. */
class WholeReportTest {

    private static final String SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize().toString();
    private static final List<String> SECTIONS = List.of("Course of the run", "Motion", "Beside real fish", "Water", "Numbers", "Command");
    private static final Pattern ROW = Pattern.compile("(?m)^\\| ([^|]+) \\| ([^|]*) \\| ([^|]+) \\| ([✔✘–]) [a-z ]+ \\|$");

    @TempDir
    private Path folder;
    private Path run;

    /** A tenth of a second is not enough to get anywhere. */
    @BeforeEach
    void evolve() {
        run = folder.resolve("run");
        Commands.natator("evolve", "--simulator-path", SIMULATOR, "--scene", "pool/creature-1", "--population", "4", "--generations",
                "1", "--duration", "0.1", "--output-dir", run.toString());
    }

    private String report() throws IOException {
        Commands.natator("report", "--simulator-path", SIMULATOR, run.toString());
        return Files.readString(run.resolve("report/README.md"));
    }

    private static List<String> outcomes(String page) {
        List<String> outcomes = new ArrayList<>();
        for (Matcher row = ROW.matcher(page); row.find();) {
            outcomes.add(row.group(1) + " " + row.group(4));
        }
        return outcomes;
    }

    @Test
    void ofAWinnerThatGetsNowhereByAllItsControls() throws IOException {
        Commands.natator("check", "--simulator-path", SIMULATOR, "--starts", "2", run.toString());

        String page = report();

        assertThat(page).startsWith("# pool/creature-1, seed 1\n\n**The best gait does not swim: moves ").doesNotContain("NaN", "null");
        assertThat(page).containsSubsequence("By its controls it does not swim: ", "ork of the muscles ", "To go on: try more --generations",
                "[Motion](#motion)", "![the swimmer in its tank](swimmer.png)", "| measure | value | of a swimmer | outcome |",
                "After ± stands a standard deviation.");
        assertThat(outcomes(page)).hasSize(6).contains("way, 4 fresh starts ✘", "resting muscles ✘",
                "share of the body under water ✔").noneMatch(outcome -> outcome.endsWith("–"));
        assertThat(page).containsSubsequence(SECTIONS.stream().map(section -> "\n## " + section + "\n").toList())
                .containsPattern("It moves like \\*\\*(none|anguilliform|carangiform|thunniform)\\*\\*")
                .containsPattern("The simulated curves end at [01]\\.\\d\\d of the length");

        String html = Files.readString(run.resolve("report/report.html"));
        assertThat(html).contains("class=\"fails\">✘ does not", "class=\"holds\">✔ holds", "class=\"portrait\"", "class=\"chart\"",
                "<details><summary>all numbers</summary>").doesNotContain("src=\"swimmer", "class=\"unknown\"");
        for (String section : SECTIONS) {
            String anchor = section.toLowerCase().replace(' ', '-');
            assertThat(html).contains("href=\"#" + anchor + "\"", "id=\"" + anchor + "\"");
        }
    }

    /** A thesis' creature: pictures of its motion and its water, and what it is like; also while the run goes on. */
    @Test
    void ofACreatureOfTheThesis() throws IOException {
        Path second = folder.resolve("second");
        Commands.natator("evolve", "--simulator-path", SIMULATOR, "--scene", "thesis/creature-2", "--population", "4", "--generations", "0",
                "--duration", "0.05", "--output-dir", second.toString());
        Commands.natator("report", "--simulator-path", SIMULATOR, second.toString());

        assertThat(Files.readString(second.resolve("report/README.md"))).contains("# thesis/creature-2, seed 1",
                "![rotation over time](rotation.png)", "flow-side.png", "| e against anguilliform fish (α, β) | 0.").doesNotContain("NaN", "not finished");

        Path config = second.resolve("config.json");
        Files.writeString(config, Files.readString(config).replaceFirst("\"generations\" : 0", "\"generations\" : 3"));
        Commands.natator("report", "--simulator-path", SIMULATOR, second.toString());
        assertThat(Files.readString(second.resolve("report/README.md")))
                .startsWith("# thesis/creature-2, seed 1\n\n**This run is not finished.** Done are generation 0 of 3 and ");
    }

    @Test
    void ofAWinnerThatFellApart() throws IOException {
        Path file = run.resolve("best.json");
        ObjectNode best = (ObjectNode) Json.parse(Files.readString(file), JsonNode.class);
        best.remove(List.of("fresh", "vacuum"));
        best.put("distance", 0).put("speed", 0).set("result", Json.parse("{\"id\":3,\"status\":\"unstable\",\"stopped\":\"unstable\","
                + "\"distance\":null,\"simulated\":0.05,\"frames\":3,\"scheme\":\"conserving\",\"precision\":\"float\","
                + "\"unstable\":{\"particle\":7,\"stage\":\"frame\",\"time\":0.05,\"law\":\"shape\"}}", JsonNode.class));
        Files.writeString(file, Json.document(best));

        String page = report();

        assertThat(page).startsWith("# pool/creature-1, seed 1\n\n**The best gait is not judged: unstable at 0.05 s (broke law shape)**")
                .doesNotContain("NaN", "null").contains("`natator check " + run + "` runs them");
        assertThat(outcomes(page)).containsExactly("way, one run ✘", "half the time step –", "without water –", "resting muscles –",
                "mirrored –");
    }
}
