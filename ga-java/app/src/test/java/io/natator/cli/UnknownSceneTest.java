package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** What is said of scenes and run folders that are not there, with the real simulator. */
class UnknownSceneTest extends CommandTest {

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "page runs/nothing|runs/nothing is neither a run folder nor a scene",
            "page --duration 0.1 runs/nothing|runs/nothing is neither a run folder nor a scene",
            "page --duration 0.1 thesis/creature-1 open-watr/ray|open-watr/ray is neither a run folder nor a scene; did you mean open-water/ray, lake/ray or pool/ray?",
            "page tuna|tuna is neither a run folder nor a scene; did you mean lake/tuna, pool/tuna or open-water/tuna?",
            "page gone.json|gone.json is neither a run folder nor a scene: there is no such file",
            "evolve --creature minnow|--creature is minnow; expected 1, 2, 3, 4, eel, ray, tadpole or tuna",
            "evolve --creature tadpol --preset thesis|--creature is tadpol; expected 1, 2, 3, 4, eel, ray, tadpole or tuna; did you mean tadpole?",
            "view --creature minnow|--creature is minnow; expected 1, 2, 3, 4, eel, ray, tadpole or tuna",
            "evaluate --scene pool/tunaa --gait 1|--scene is pool/tunaa; expected a named scene (natator-sim info lists them) or a file NAME.json; did you mean pool/tuna, "
                    + "lake/tuna or open-water/tuna?",
            "evolve --scene pool/eal|--scene is pool/eal; expected a named scene (natator-sim info lists them) or a file NAME.json; did you mean pool/eel, "
                    + "lake/eel or endless/eel?"})
    void onlyWhatIsNearIsNamed(String arguments, String message) {
        List<String> all = new ArrayList<>(List.of(arguments.split(" ")));
        switch (all.get(0)) {
            case "page" -> all.addAll(1, List.of("--output", path("new.html")));
            case "view" -> all.addAll(1, List.of("--port", "0", "--no-browser"));
            case "evaluate" -> {
            }
            default -> all.addAll(1, List.of("--output-dir", path("new")));
        }

        refused(natator(all)).isEqualTo("natator " + all.get(0) + ": " + message + "\n");
        assertThat(folder).isEmptyDirectory();
    }

    @Test
    void aSceneThatIsThereIsRefusedInTheSimulatorsWords() throws Exception {
        Path file = Files.writeString(folder.resolve("scene.json"), "{\"base\": \"no/such\"}");
        String page = path("new.html");

        refused(natator("page", "--output", page, file.toString())).hasLineCount(1).contains("no/such")
                .doesNotContain("neither");
        refused(natator("page", "--output", page, "--overrides", "{\"solver\":{\"substeps\":0}}", "pool/eel"))
                .hasLineCount(1).contains("substeps").doesNotContain("neither");
    }
}
