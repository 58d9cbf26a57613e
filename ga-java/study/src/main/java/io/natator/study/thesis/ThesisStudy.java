package io.natator.study.thesis;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.config.Limits;
import io.natator.config.Scheme;
import io.natator.report.FirstScreen;
import io.natator.report.Recording;
import io.natator.report.RecordingFactory;
import io.natator.simulator.Evaluator;
import io.natator.simulator.SimulationRequest;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;

/**
 * The measuring half of the study: what the published gaits and the evolved ones do. Everything is kept in files of the
 * study's folder, row by row, so that it continues where it was stopped.
 */
public final class ThesisStudy implements AutoCloseable {

    private final Path directory;
    private final Double duration;
    private final List<EvolvedRun> evolved;
    private final ExperimentCatalogue catalogue;
    private final ThesisData data = ThesisData.load();
    private final MeasurementLog measurements;
    private final KinematicsLog motions;
    private final TimingLog timings;

    /**
     * Opens the study.
     *
     * @param plan     its evolutions; those that are finished are measured
     * @param runs     of every experiment, at least 1
     * @param duration simulated seconds, or null for the scenes' own
     */
    public ThesisStudy(Path directory, EvolutionPlan plan, int runs, Double duration) {
        Limits.checkCount("--runs", runs, Limits.REPETITIONS);
        this.directory = directory;
        this.duration = duration;
        this.evolved = plan.finished();
        this.catalogue = new ExperimentCatalogue(data, evolved, duration, directory);
        this.measurements = new MeasurementLog(directory, runs);
        this.motions = new KinematicsLog(directory, runs);
        this.timings = new TimingLog(directory);
    }

    /** How many evaluations are still to be measured. */
    public int missingMeasurements() {
        return measurements.missing(catalogue.all()).size();
    }

    /** How many runs are still to be recorded or timed on the processor. */
    public int missingRecordings() {
        long pictures = pictured().entrySet().stream().filter(picture -> recorded(picture).isEmpty()).count();
        return motions.missing(catalogue.recorded()).size() + (int) pictures
                + timings.missing(catalogue.timed()).size();
    }

    /**
     * Measures speeds.
     *
     * @param done called after each evaluation
     * @throws InterruptedException if the evaluator is closed; what is finished is kept
     */
    public void measure(Evaluator evaluator, ExecutionSettings execution, Runnable done) throws InterruptedException {
        measurements.measure(catalogue.all(), evaluator, execution, done);
    }

    /**
     * Records how the bodies move, makes the recordings for pictures, and times the parameter study, on the processor.
     *
     * @param done called after each run
     * @throws InterruptedException if the calling thread is interrupted; what is finished is kept
     */
    public void record(ExecutionSettings execution, Runnable done) throws InterruptedException {
        motions.record(catalogue.recorded(), execution, done);
        for (Map.Entry<String, SimulationRequest> picture : pictured().entrySet()) {
            if (recorded(picture).isEmpty()) {
                double seconds = duration == null ? ExperimentCatalogue.THESIS_SECONDS : duration;
                RecordingFactory.of(picture.getValue(), seconds / 2, execution).write(recording(picture.getKey()));
                done.run();
            }
        }
        timings.time(catalogue.timed(), execution, done);
    }

    private Path recording(String name) {
        return directory.resolve("recordings").resolve(name + ".json.gz");
    }

    /** What is drawn, by the name of its files: the published gaits in flex, and the best that evolved. */
    private Map<String, SimulationRequest> pictured() {
        Map<String, SimulationRequest> pictured = new LinkedHashMap<>();
        for (ThesisData.PublishedGait gait : data.gaits()) {
            pictured.put("thesis-" + gait.name(), catalogue.speeds(gait, Scheme.FLEX).get(0).request());
        }
        for (EvolvedRun run : bestEvolved()) {
            SimulationRequest request = catalogue.speeds(run).get(0).request();
            ObjectNode on = ((ObjectNode) request.overrides()).deepCopy();
            ((ObjectNode) on.get("stopping")).put("planeContact", false);
            pictured.put("creature-" + run.creature() + "-" + run.scheme().name().toLowerCase(Locale.ROOT),
                    new SimulationRequest(0, request.scene(), request.gait(), request.duration(), request.scheme(), on));
        }
        return pictured;
    }

    /** Of each creature in each scheme the best evolution that is measured. */
    private List<EvolvedRun> bestEvolved() {
        StudyResults results = results();
        return evolved.stream().map(EvolvedRun::creature).distinct().sorted()
                .flatMap(creature -> ExperimentCatalogue.SCHEMES.stream().map(scheme -> results.best(creature, scheme)))
                .filter(Objects::nonNull).toList();
    }

    private StudyResults results() {
        return new StudyResults(data, catalogue, measurements, motions, timings, evolved);
    }

    /** The recording of just this, if there is one: with more seeds another run may be the best. */
    private Optional<Recording> recorded(Map.Entry<String, SimulationRequest> picture) {
        Path file = recording(picture.getKey());
        String request = Json.line(picture.getValue().withId(0));
        return Optional.of(file).filter(Files::exists).map(Recording::read)
                .filter(found -> Json.line(found.request().withId(0)).equals(request));
    }

    /** Recordings that are there, by name. */
    private Map<String, Recording> recordings() {
        Map<String, Recording> found = new LinkedHashMap<>();
        pictured().entrySet().forEach(
                picture -> recorded(picture).ifPresent(recording -> found.put(picture.getKey(), recording)));
        return found;
    }

    /**
     * Writes the report on what is there.
     *
     * @param plan     the evolutions that were asked for
     * @param command  what the study was made by
     * @param portrait draws the swimmer of {@link #portrayed}; null for none
     * @return the page
     * @throws InterruptedException if the calling thread is interrupted
     */
    public Path report(EvolutionPlan plan, String command, FirstScreen.Portrait portrait) throws InterruptedException {
        return new ThesisReport(directory, results(), plan.runs().size(), recordings(), command, portrait).write();
    }

    /** The run folder whose winner the report shows; empty if nothing evolved was measured. */
    public Optional<Path> portrayed() {
        StudyResults results = results();
        return new Answers(results, new ClaimsSection(results)).portrayed().map(run -> run.plan().directory());
    }

    @Override
    public void close() {
        measurements.close();
        motions.close();
        timings.close();
    }
}
