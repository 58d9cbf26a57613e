package io.natator.study.thesis;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.Backend;
import io.natator.config.EncodingKind;
import io.natator.config.ExecutionSettings;
import io.natator.config.Scheme;
import io.natator.encoding.Gait;
import io.natator.evolution.ToySimulator;
import io.natator.kinematics.FishMode;
import io.natator.report.RecordingFactory;
import io.natator.simulator.Evaluator;
import io.natator.simulator.FakeSimulator;
import io.natator.simulator.SceneInfo;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.WorkerPool;
import io.natator.study.Sample;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class ThesisStudyTest {

    private static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize();
    private static final int RUNS = 2;
    private static final double DURATION = 0.3;

    @TempDir
    private Path folder;

    private EvolutionPlan nothingEvolved() throws InterruptedException {
        return new EvolutionPlan(List.of(1), List.of(Scheme.FLEX), 1, 4, 1, DURATION, Backend.CPU, SIMULATOR, folder);
    }

    private ThesisStudy study() throws InterruptedException {
        return new ThesisStudy(folder, nothingEvolved(), RUNS, DURATION);
    }

    private int measure(ThesisStudy study) throws InterruptedException {
        Path fake = folder.resolve("fake-simulator.sh");
        ExecutionSettings execution = new ExecutionSettings(Files.exists(fake) ? fake : FakeSimulator.in(folder), 2,
                Duration.ofMinutes(5));
        AtomicInteger count = new AtomicInteger();
        try (Evaluator evaluator = new WorkerPool(new ToySimulator(), 2)) {
            study.measure(evaluator, execution, count::incrementAndGet);
        }
        return count.get();
    }

    @Test
    void measuresEverythingOnceAndGoesOnAfterACut() throws IOException, InterruptedException {
        int all;
        try (ThesisStudy study = study()) {
            all = study.missingMeasurements();
            assertThat(measure(study)).isEqualTo(all).isGreaterThan(500);
            assertThat(study.missingMeasurements()).isZero();
        }
        Path file = folder.resolve("measurements.jsonl");
        List<String> lines = Files.readAllLines(file);
        assertThat(lines).hasSize(all).doesNotHaveDuplicates();
        Files.writeString(file, String.join("\n", lines.subList(0, all - 5)) + "\n" + lines.get(all - 5).substring(0, 40));

        try (ThesisStudy study = study()) {
            assertThat(study.missingMeasurements()).isEqualTo(5);
            assertThat(measure(study)).isEqualTo(5);
        }
        assertThat(Files.readAllLines(file)).hasSize(all).containsExactlyInAnyOrderElementsOf(lines);
    }

    /** What is recorded is what the simulator does; the report has it, and leaves out what is not there. */
    @Test
    void reportsOnWhatIsThere() throws IOException, InterruptedException {
        ExecutionSettings execution = new ExecutionSettings(SIMULATOR, 2, Duration.ofMinutes(5));
        ThesisData data = ThesisData.load();
        ExperimentCatalogue catalogue = new ExperimentCatalogue(data, List.of(), DURATION, folder);
        Experiment experiment = catalogue.speeds(data.gait("2"), Scheme.FLEX).get(0);
        try (KinematicsLog motions = new KinematicsLog(folder, RUNS)) {
            motions.record(List.of(experiment), execution, () -> { });
            assertThat(motions.of(experiment)).hasSize(RUNS).allSatisfy(motion -> {
                assertThat(motion.simulated()).isCloseTo(DURATION, within(1e-6));
                assertThat(motion.bodyLength()).isCloseTo(18 * 0.075, within(1e-3));
                assertThat(motion.heights().get(0)).isCloseTo(0.6, within(1e-2));
            });
            assertThat(motions.missing(List.of(experiment))).isEmpty();
        }
        RecordingFactory.of(experiment.request(), DURATION / 2, execution)
                .write(folder.resolve("recordings").resolve("thesis-2.json.gz"));
        Path page;
        try (ThesisStudy study = study()) {
            measure(study);
            page = study.report(nothingEvolved(), "the command", null);
        }

        String text = Files.readString(page);
        assertThat(text).containsSubsequence("# The thesis, redone", "**Of the thesis' gaits ", " swim", "[Pictures](#pictures)",
                "| creature | thesis' gait, flex |", "| 2, with twice", "figures/answers.png", "## All verdicts",
                "<details><summary>every gait</summary>", "<details><summary>every conclusion</summary>", "## How it was made");
        assertThat(text).contains("0 of 1 evolutions are finished",
                "| 1 | published | 0.1834 | 0.1511 | 0.1997 | carangiform |", "Published gait 2, flex",
                "figures/3.5-flow-thesis-2.png", "figures/4.1-acceleration-clamp.png", "the command")
                .doesNotContain("NaN", "Published gait 1, flex", "null");
        try (Stream<Path> pictures = Files.list(folder.resolve("figures"))) {
            assertThat(pictures).hasSizeGreaterThan(15)
                    .allSatisfy(file -> assertThat(file.toString()).endsWith(".png"));
        }
        assertThat(Files.readString(folder.resolve("report.html"))).contains("data:image/png;base64,");
    }

    /** A parameter's standard value is the scene's own: the same request as that of the plain gait. */
    @Test
    void theStandardValueOfEveryParameterIsTheScenesOwn() {
        ThesisData data = ThesisData.load();
        ExperimentCatalogue catalogue = new ExperimentCatalogue(data, List.of(), null, folder);
        SimulationRequest plain = catalogue.speeds(data.gait("1"), Scheme.FLEX).get(0).request();
        for (Parameter parameter : Parameter.values()) {
            List<SimulationRequest> requests = catalogue.study(parameter, "1", Scheme.FLEX).stream()
                    .filter(one -> !one.setting().startsWith("vacuum")).map(Experiment::request).toList();
            assertThat(requests).as(parameter.label()).contains(plain).doesNotHaveDuplicates()
                    .hasSize(parameter.settings().size());
        }
    }

    @Test
    void everyExtremeIsOneThatTheSimulatorTakes() throws InterruptedException {
        for (Parameter parameter : Parameter.values()) {
            boolean risesOnly = parameter.settings().get(0) == parameter.standard();
            double extreme = parameter.settings().get(risesOnly ? parameter.settings().size() - 1 : 0);
            assertThat(SceneInfo.of("thesis/creature-1", parameter.overrides(extreme), SIMULATOR).particles())
                    .as(parameter.label()).isGreaterThan(5000);
        }
    }

    @Test
    void theThesisDataAreThoseOfTheThesis() {
        ThesisData data = ThesisData.load();

        assertThat(data.gaits()).hasSize(5);
        Gait two = data.gait("2").gait();
        Gait decoded = EncodingKind.SPARSE.forActuators(8).decode(List.of(1.338, 0.504, 0.184, 0.431));
        for (int i = 0; i < 8; i++) {
            assertThat(two.amplitude().get(i)).isCloseTo(decoded.amplitude().get(i), within(1e-9));
            assertThat(two.phase().get(i)).isCloseTo(decoded.phase().get(i), within(1e-9));
        }
        assertThat(data.gait("2").published().errors().get(FishMode.ANGUILLIFORM.ordinal())).isEqualTo(0.0402);
        assertThat(data.gait("1").flex().get(0).mean()).isCloseTo(0.007, within(1e-3));
    }

    @Test
    void swimmingIsAboveNoiseAndDrift() {
        Sample still = Sample.of(List.of(0.001, -0.001));
        Sample swift = Sample.of(List.of(0.2, 0.21));
        Sample drift = Sample.of(List.of(0.15, 0.15));
        Sample noisy = Sample.of(List.of(0.3, -0.1));

        assertThat(ClaimsSection.swims(swift, still)).isEqualTo("yes");
        assertThat(ClaimsSection.swims(swift, drift)).startsWith("doubtful");
        assertThat(ClaimsSection.swims(noisy, still)).startsWith("no");
        assertThat(ClaimsSection.swims(Sample.of(List.of(-0.2, -0.2)), still)).isEqualTo("no");
        assertThat(ClaimsSection.swims(Sample.of(List.of()), still)).isEqualTo("–");
    }
}
