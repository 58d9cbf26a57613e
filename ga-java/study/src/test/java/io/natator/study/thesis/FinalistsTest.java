package io.natator.study.thesis;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.config.Judge;
import io.natator.encoding.Gait;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.GenerationSummary;
import io.natator.file.CompressedJson;
import io.natator.simulator.SimulationResult;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class FinalistsTest {

    private static final EvolutionSettings SETTINGS =
            EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2).withStarts(2, Judge.MEAN);

    @TempDir
    private Path run;
    private final List<EvaluationRecord> evaluations = new ArrayList<>();

    /** A run of a gait, which its frequency tells from others. */
    private void swim(int generation, double frequency, double distance) {
        List<Double> genes = List.of(frequency, 0.5, 0.5, 0.1);
        Gait gait = SETTINGS.genome().decode(genes).gait();
        evaluations.add(new EvaluationRecord(generation, genes, gait, new SimulationResult((long) evaluations.size(), SimulationResult.Status.OK,
                distance, "completed", 4.0, 240, "flex", "float", null, null, null), evaluations.size()));
    }

    /** Worth and number of runs of each, the best first, after this generation; the log begins with evaluation `from`. */
    private String kept(int generation, int from) throws IOException {
        Files.writeString(run.resolve("config.json"), Json.document(SETTINGS.withGenerations(generation)));
        EvolutionState state = new EvolutionState(generation, evaluations.size(), List.of(), null,
                Collections.nCopies(generation + 1, new GenerationSummary(0, 0, 0, 0, 0, 0, 0, 0, 0)));
        Files.writeString(run.resolve("checkpoint.json"), Json.document(state));
        if (from > 0) {
            CompressedJson.write(run.resolve("checkpoint.json.gz"), state);
        }
        Files.writeString(run.resolve("evaluations.jsonl"), evaluations.stream().skip(from).map(one -> Json.line(one) + "\n")
                .collect(Collectors.joining()));
        Finalists.keep(run);
        return Finalists.of(run).gaits().stream().map(one -> one.score() + "/" + one.runs()).collect(Collectors.joining(" "));
    }

    @Test
    void whatARunThatGoesOnFindsCountsOnce() throws IOException {
        swim(0, 1, 0.5);
        swim(0, 1, 0.75);
        swim(0, 1.5, 0.25);
        swim(0, 1.5, 0.25);
        assertThat(kept(0, 0)).isEqualTo("0.625/2 0.25/2");

        int dropped = evaluations.size();
        swim(1, 1, 0.25);
        swim(1, 2, 1);
        swim(1, 2, 0.5);
        assertThat(kept(1, dropped)).as("a gait that was known has its one run since").isEqualTo("0.75/2 0.5/3 0.25/2");
        assertThat(kept(1, dropped)).as("kept already").isEqualTo("0.75/2 0.5/3 0.25/2");

        swim(2, 2, 0.25);
        swim(2, 2, 0.25);
        assertThat(kept(2, dropped)).as("the log still has generation 1").isEqualTo("0.5/4 0.5/3 0.25/2");
        Files.delete(run.resolve("finalists.json"));
        assertThat(kept(2, 0)).as("of all evaluations at once").isEqualTo("0.5/3 0.5/4 0.25/2");
    }
}
