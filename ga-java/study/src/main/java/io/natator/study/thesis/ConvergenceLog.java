package io.natator.study.thesis;

import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.simulator.ConvergeProgram;
import io.natator.simulator.FinerLevel;
import io.natator.simulator.Sha256;
import io.natator.simulator.SimulationRequest;
import java.nio.file.Path;
import java.util.List;

/** Gaits at half the spacing of all particles, the body and its motion kept; {@code convergence.jsonl}. */
final class ConvergenceLog extends RequestLog<ConvergenceLog.Row> {

    private static final FinerLevel LEVEL = FinerLevel.HALF_SPACING;
    private static final int STARTS = 3;

    /**
     * A line of the file.
     *
     * @param program SHA-256 of the native program
     * @param backend what it computed on
     * @param request from the scene's own start
     * @param answer  of {@code natator-sim converge}
     */
    record Row(@JsonProperty(required = true) String program, @JsonProperty(required = true) Backend backend,
            @JsonProperty(required = true) SimulationRequest request, @JsonProperty(required = true) JsonNode answer) implements Answer {
    }

    /** That of a study. */
    ConvergenceLog(Path directory) {
        super(directory.resolve("convergence.jsonl"), Row.class);
    }

    /** Those that are not measured yet. */
    List<Experiment> missing(List<Experiment> experiments) {
        return experiments.stream().filter(one -> find(one.request()) == null).toList();
    }

    /**
     * Measures what is missing.
     *
     * @param done called after each
     * @throws InterruptedException if the calling thread is interrupted; what is finished is kept
     */
    void measure(List<Experiment> experiments, ExecutionSettings execution, Runnable done) throws InterruptedException {
        String program = Sha256.of(execution.simulator());
        for (Experiment experiment : missing(experiments)) {
            JsonNode answer = new ConvergeProgram(execution).of(experiment.request(), STARTS, List.of(LEVEL));
            add(new Row(program, execution.backend(), experiment.request().withId(0L), answer));
            done.run();
        }
    }

    /** Speed at half the spacing less that as it is, from the same starts; NaN if that was not measured or became unstable. */
    double change(Experiment experiment) {
        Row row = find(experiment.request());
        return row == null ? Double.NaN : speed(row, LEVEL.label()) - speed(row, "base");
    }

    private static double speed(Row row, String level) {
        for (JsonNode one : row.answer().path("levels")) {
            if (one.path("level").asText().equals(level)) {
                return one.path("speed").path("mean").asDouble(Double.NaN);
            }
        }
        return Double.NaN;
    }
}
