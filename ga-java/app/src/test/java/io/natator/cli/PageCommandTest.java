package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;

/** {@code natator page} with the real simulator. */
class PageCommandTest extends CommandTest {

    @Test
    void fourSecondsWithWaterAreBelowTenMegabytes() throws IOException {
        Path gait = Files.writeString(folder.resolve("gait.json"),
                "{\"frequency\":1.861,\"amplitude\":[0.973,0.69],\"phase\":[0,0.648]}");
        Path page = folder.resolve("page.html");

        ok(natator("page", "thesis/creature-1", "--gait", gait.toString(), "--duration", "4", "--output",
                page.toString()));

        assertThat(Files.size(page)).isBetween(1_000_000L, 10_000_000L);
        assertThat(out.toString()).startsWith(page + ": ").contains(" MB, 60 frames a second, water to 3e-05");
    }

    @Test
    void planeFlowComesWithItsWake() {
        ok(natator("page", "plane/loach", "--duration", "0.1", "--output", path("page.html")))
                .endsWith(", with the wake\n");
    }

    @Test
    void theBestOfARun() throws IOException {
        Path run = folder.resolve("run");
        ok(natator("evolve --creature 1 --population 6 --generations 1 --duration 0.1", "--output-dir",
                run.toString()));
        Path page = folder.resolve("page.html");

        ok(natator("page", run.toString(), "--best", "2", "--no-water", "--output", page.toString()))
                .endsWith(", no water\n");
        assertThat(Files.readString(page).split("class=\"swim\" data-title=\"run: ", -1)).hasSize(3);
    }

    @Test
    void aPageIsReplacedOnlyIfWanted() throws IOException {
        Path page = Files.writeString(folder.resolve("page.html"), "mine");
        List<String> arguments = new ArrayList<>(
                List.of("page", "pool/creature-1", "--duration", "0.05", "--no-water", "--output", page.toString()));

        refused(natator(arguments)).isEqualTo("natator page: output file " + page
                + " is already there; choose another by --output, or replace it by --force\n");
        assertThat(page).hasContent("mine");

        arguments.add("--force");
        ok(natator(arguments));
        assertThat(page).content().contains("class=\"swim\"");
    }

    @Test
    void badInput() {
        refused(natator("page", "thesis/creature-1", "--best", "0")).contains("--best is 0; expected");
        refused(natator("page", "thesis/creature-1", "--best", "2"))
                .contains("--best is 2; expected 1 with thesis/creature-1, which is no run folder\n");
        refused(natator("page")).contains("no RUN or SCENE is named; expected at least one, or --live");
        refused(natator("page", "--live", "--best", "2")).contains("--live with --best; expected --output");
        refused(natator("page", "pool/eel", "--live")).contains("--live with pool/eel; expected --output");
        refused(natator("page", "thesis/creature-1", "--max-size", "0")).contains("--max-size is 0.0; expected");
        refused(natator("page", "no/such", "--duration", "0.1")).contains("no/such");
        refused(natator("page", "thesis/creature-1", "--output", folder.toString()))
                .contains("output file is " + folder + ", which is a folder; expected the name of a file");
    }
}
