package io.natator.study.thesis;

import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.config.Limits;
import io.natator.config.SimulatorMode;
import io.natator.encoding.Gait;
import io.natator.file.GeneratedPage;
import io.natator.report.Recording;
import io.natator.report.RecordingFactory;
import io.natator.simulator.Evaluator;
import io.natator.simulator.SimulationRequest;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.IntConsumer;

/**
 * The measuring half of the study: what the published gaits and the evolved ones do. Everything is kept in files of the
 * study's folder, row by row, so that it continues where it was stopped.
 */
public final class ThesisStudy implements AutoCloseable {

    /** Runs of a gait whose motion is recorded. */
    private static final int RECORDED = 3;

    private final Path directory;
    private final Double duration;
    private final StudyResults results;

    /**
     * Opens the study.
     *
     * @param plan     its evolutions; those that are finished are measured
     * @param starts   of every gait in its water, at least 2
     * @param duration simulated seconds, or null for the scenes' own
     */
    public ThesisStudy(Path directory, EvolutionPlan plan, int starts, Double duration) {
        Limits.checkCount("--runs", starts, Limits.REPETITIONS);
        GeneratedPage.check(directory);
        this.directory = directory;
        this.duration = duration;
        ThesisData data = ThesisData.load();
        ExperimentCatalogue catalogue = new ExperimentCatalogue(data, duration, starts);
        MeasurementLog measurements = new MeasurementLog(directory.resolve("measurements.jsonl"));
        this.results = new StudyResults(data, directory, catalogue, measurements, new MeasurementLog(directory.resolve("processor.jsonl")),
                new ConvergenceLog(directory), new KinematicsLog(directory, Math.min(RECORDED, starts)),
                new Winners(directory, catalogue, measurements, plan.finished()),
                duration == null ? StudyResults.THESIS_SECONDS : duration);
    }

    /** How many evaluations are still to be measured, as far as is known: winners are known once their finalists are measured. */
    public int missingMeasurements() {
        return results.measurements().missing(results.experiments()).size();
    }

    /** How many gaits are still to be run at half the spacing. */
    public int missingLevels() {
        return results.convergence().missing(results.evolvedInWater()).size();
    }

    /** How many runs are still to be recorded, or measured on the processor. */
    public int missingRecordings() {
        long pictures = pictured().entrySet().stream().filter(picture -> recorded(picture).isEmpty()).count();
        return results.motions().missing(results.recorded()).size() + (int) pictures
                + results.processor().missing(results.onProcessor()).size();
    }

    /**
     * Measures speeds: first what is known, then what that has found.
     *
     * @param round called before each round with its number of evaluations
     * @param done  called after each evaluation
     * @throws InterruptedException if the evaluator is closed; what is finished is kept
     */
    public void measure(Evaluator evaluator, ExecutionSettings execution, IntConsumer round, Runnable done) throws InterruptedException {
        results.measurements().measureAll(results::experiments, evaluator, execution, round, done);
    }

    /**
     * Runs what evolved at half the spacing of all particles.
     *
     * @param done called after each gait
     * @throws InterruptedException if the calling thread is interrupted; what is finished is kept
     */
    public void converge(ExecutionSettings execution, Runnable done) throws InterruptedException {
        results.convergence().measure(results.evolvedInWater(), execution, done);
    }

    /**
     * On the processor: measures the gaits in their water again, records how the bodies move, and makes the recordings for
     * pictures.
     *
     * @param done called after each run
     * @throws InterruptedException if the calling thread is interrupted; what is finished is kept
     */
    public void record(ExecutionSettings execution, Runnable done) throws InterruptedException {
        ExecutionSettings processor = execution.withCommands(List.of()).withBackend(Backend.CPU).withMode(SimulatorMode.RESIDENT);
        if (!results.processor().missing(results.onProcessor()).isEmpty()) {
            try (Evaluator evaluator = Evaluator.open(processor)) {
                results.processor().measure(results.onProcessor(), evaluator, processor, done);
            }
        }
        results.motions().record(results.recorded(), processor, done);
        for (Map.Entry<String, SimulationRequest> picture : pictured().entrySet()) {
            if (recorded(picture).isEmpty()) {
                RecordingFactory.of(picture.getValue(), results.duration() / 2, processor).write(recording(picture.getKey()));
                done.run();
            }
        }
    }

    /**
     * Drops what was measured of gaits that the study has no more, as an evolution that went on has other finalists; nothing
     * while anything is still to be measured, since what the study has is not known before. To be called before anything is
     * added.
     *
     * @return how many rows were dropped
     */
    public int dropOutdated() {
        if (missingMeasurements() + missingLevels() + missingRecordings() > 0) {
            return 0;
        }
        Set<Gait> gaits = results.gaits();
        return results.measurements().keep(gaits) + results.processor().keep(gaits) + results.convergence().keep(gaits)
                + results.motions().keep(gaits);
    }

    private Path recording(String name) {
        return directory.resolve("recordings").resolve(name + ".json.gz");
    }

    /** What is drawn, by the name of its files: the published gaits in flex, and the best that evolved. */
    private Map<String, SimulationRequest> pictured() {
        Map<String, SimulationRequest> pictured = new LinkedHashMap<>();
        results.drawn().forEach((name, subject) -> pictured.put(name, Condition.WATER.of(subject, duration).withoutStops()));
        return pictured;
    }

    /** The recording of just this, if there is one: with more seeds another run may be the best. */
    private Optional<Recording> recorded(Map.Entry<String, SimulationRequest> picture) {
        Path file = recording(picture.getKey());
        String request = Json.line(picture.getValue().withId(0L));
        return Optional.of(file).filter(Files::exists).map(Recording::read)
                .filter(found -> Json.line(found.request().withId(0L)).equals(request));
    }

    /** Recordings that are there, by name. */
    private Map<String, Recording> recordings() {
        Map<String, Recording> found = new LinkedHashMap<>();
        pictured().entrySet().forEach(
                picture -> recorded(picture).ifPresent(recording -> found.put(picture.getKey(), recording)));
        return found;
    }

    /**
     * Runs again, on the processor, some of the runs that were measured there, drawn by chance.
     *
     * @param waters    in which
     * @param count     how many
     * @param seed      of the choice
     * @param execution with a time limit
     * @return each of them
     * @throws InterruptedException if the calling thread is interrupted
     */
    public List<Repeated> repeat(List<Water> waters, int count, long seed, ExecutionSettings execution) throws InterruptedException {
        return Repeated.of(results.processor().rows().stream().filter(row -> waters.stream()
                .anyMatch(water -> water.scheme() == row.request().scheme())).toList(), count, seed, execution);
    }

    /**
     * Writes the report on what is there.
     *
     * @param plan     the evolutions that were asked for
     * @param command  what the study is made by, line by line
     * @return the page
     * @throws InterruptedException if the calling thread is interrupted
     */
    public Path report(EvolutionPlan plan, String command) throws InterruptedException {
        return new ThesisReport(results, plan.begun().size(), recordings(), command).write();
    }

    @Override
    public void close() {
        results.close();
    }
}
