package io.natator.study.thesis;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.report.ReportDocument;
import io.natator.run.PlannedRun;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** What the page says of how gaits were searched for. */
class MethodsSectionTest {

    @TempDir
    private Path folder;
    private final List<EvolvedRun> runs = new ArrayList<>();

    private void evolve(int creature, int generations, double duration) throws IOException {
        Path directory = folder.resolve("runs/creature-" + creature + "/open-water/seed-1");
        EvolutionSettings settings = EvolutionSettings.of("open-water/creature-" + creature, EncodingKind.DENSE, 2).withSize(60, generations)
                .withScene(Water.OPEN_WATER.scheme(), duration, Water.OPEN_WATER.evolving(1).overrides());
        Files.createDirectories(directory);
        Files.writeString(directory.resolve("config.json"), Json.document(settings));
        Finalists.Finalist gait = new Finalists.Finalist(new Gait(1.0, List.of(0.5, 0.5), List.of(0.0, 0.5)), 1, 2);
        Files.writeString(directory.resolve("finalists.json"), Json.document(new Finalists(List.of(gait), generations)));
        runs.add(new EvolvedRun(creature, Water.OPEN_WATER, 1, new PlannedRun(settings, directory)));
    }

    private String page() throws IOException {
        try (StudyResults results = OpenStudy.of(folder, new ExperimentCatalogue(ThesisData.load(), null, 4), runs)) {
            ReportDocument page = new ReportDocument(folder, "title");
            new MethodsSection(results).add(page);
            return Files.readString(page.write("page.md"));
        }
    }

    @Test
    void aSearchIsToldOnceWithTheLeastAndTheMostGenerations() throws IOException {
        evolve(1, 70, 1.75);
        evolve(2, 100, 1.75);

        assertThat(page()).contains("In open water 2 evolutions of 60 chromosomes over 70 to 100 generations", ", 1.75 s a run");
    }

    @Test
    void creaturesThatWereSearchedForInOtherWaysAreToldApart() throws IOException {
        evolve(1, 70, 1.75);
        evolve(2, 100, 2.5);
        evolve(3, 70, 1.75);
        evolve(4, 70, 1.75);

        assertThat(page()).contains("In open water 3 evolutions of creatures 1, 3 and 4, of 60 chromosomes over 70 generations",
                "In open water 1 evolution of creature 2, of 60 chromosomes over 100 generations");
    }
}
