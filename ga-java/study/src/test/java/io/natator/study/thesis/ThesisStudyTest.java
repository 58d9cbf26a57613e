package io.natator.study.thesis;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.Backend;
import io.natator.config.EncodingKind;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
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
import java.util.regex.MatchResult;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class ThesisStudyTest {

    private static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize();
    private static final int RUNS = 2;
    private static final double DURATION = 0.3;

    @TempDir
    private Path folder;
    private final ThesisData data = ThesisData.load();

    private EvolutionPlan nothingEvolved() throws InterruptedException {
        return new EvolutionPlan(List.of(1), List.of(Water.FLEX), 1, new EvolutionPlan.Size(4, 1, 1, DURATION), Backend.CPU, SIMULATOR, folder);
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
            study.measure(evaluator, execution, round -> { }, count::incrementAndGet);
        }
        return count.get();
    }

    @Test
    void measuresEverythingOnceAndGoesOnAfterACut() throws IOException, InterruptedException {
        int all;
        try (ThesisStudy study = study()) {
            all = study.missingMeasurements();
            assertThat(measure(study)).isEqualTo(all).isGreaterThan(300);
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

    /** The committed study has no row too many; of a gait that it does not have, one is dropped, but not while anything is missing. */
    @Test
    void whatWasMeasuredOfGaitsThatAreNoMoreIsDropped() throws IOException, InterruptedException {
        Path committed = Path.of("../../results/thesis");
        try (Stream<Path> files = Files.walk(committed)) {
            for (Path file : files.filter(one -> one.toString().matches(".*(jsonl|/(config|checkpoint|best|finalists)\\.json|recordings/.*)")).toList()) {
                Path copy = folder.resolve(committed.relativize(file));
                Files.createDirectories(copy.getParent());
                Files.copy(file, copy);
            }
        }
        Path file = folder.resolve("processor.jsonl");
        String rows = Files.readString(file);
        String outdated = rows.lines().findFirst().orElseThrow().replaceFirst("\"frequency\":", "\"frequency\":1");
        assertThat(dropped()).isZero();
        Files.writeString(file, outdated + "\n" + rows);
        Path recording = folder.resolve("recordings/thesis-1.json.gz");
        Files.move(recording, folder.resolve("away"));
        assertThat(dropped()).isZero();
        Files.move(folder.resolve("away"), recording);

        assertThat(dropped()).isEqualTo(1);

        assertThat(file).hasContent(rows);
        Files.createDirectories(folder.resolve("runs/creature-3/open-water/seed-17"));
        assertThat(EvolutionPlan.isAnyUnderWay(folder)).as("of any seed").isTrue();
    }

    private int dropped() throws InterruptedException {
        EvolutionPlan all = new EvolutionPlan(List.of(1, 2, 3, 4), List.of(Water.values()), null, new EvolutionPlan.Size(null, null, null, null),
                Backend.CPU, SIMULATOR, folder);
        assertThat(EvolutionPlan.isAnyUnderWay(folder)).isFalse();
        assertThat(all.finished()).hasSizeGreaterThan(30);
        try (ThesisStudy study = new ThesisStudy(folder, all, 8, null)) {
            return study.dropOutdated();
        }
    }

    /** What is recorded is what the simulator does; the report has it, and leaves out what is not there. */
    @Test
    void reportsOnWhatIsThere() throws IOException, InterruptedException {
        ExecutionSettings execution = new ExecutionSettings(SIMULATOR, 2, Duration.ofMinutes(5));
        ExperimentCatalogue catalogue = new ExperimentCatalogue(data, DURATION, RUNS);
        Experiment experiment = catalogue.of(Subject.of(data.gait("2"), Water.FLEX), Condition.WATER);
        try (KinematicsLog motions = new KinematicsLog(folder, RUNS)) {
            motions.record(List.of(experiment), execution, () -> { });
            assertThat(motions.of(experiment)).hasSize(RUNS).allSatisfy(motion -> {
                assertThat(motion.simulated()).isCloseTo(DURATION, within(1e-6));
                assertThat(motion.bodyLength()).isCloseTo(18 * 0.075, within(1e-3));
                assertThat(motion.heights().get(0)).isCloseTo(0.6, within(1e-2));
                assertThat(motion.underWater()).isBetween(0.2, 0.8);
                assertThat(motion.measuredPart()).isBetween(0.5, 1.0);
            });
            assertThat(motions.missing(List.of(experiment))).isEmpty();
        }
        RecordingFactory.of(experiment.request().withoutStops(), DURATION / 2, execution)
                .write(folder.resolve("recordings").resolve("thesis-2.json.gz"));
        Path page;
        try (ThesisStudy study = study()) {
            measure(study);
            page = study.report(nothingEvolved(), "the command");
        }

        String text = Files.readString(page);
        assertThat(text).containsSubsequence("# The thesis, redone", "**Of the thesis' gaits ", " swim by every control",
                "| creature | published | thesis' gait, flex |", "| 2, with twice", "figures/answers.png", "## The question",
                "## How it was judged", "## What swims", "## Which conclusions hold", "## Beside the thesis and Flex 1.2.0", "## How it was made");
        assertThat(text).contains("0 of 1 evolutions are finished", "No evolution is finished.",
                "| 1 | published | 0.1834 | 0.1511 | 0.1997 |", "Gait 2 of the thesis, flex",
                "figures/3.5-flow-thesis-2.png", "#### acceleration clamp, flex", "the command")
                .doesNotContain("NaN", "Gait 1 of the thesis, flex", "null");
        try (Stream<Path> pictures = Files.list(folder.resolve("figures"))) {
            assertThat(pictures.map(file -> file.getFileName().toString())).as("of the one recorded gait; none of parameters, as it does not swim")
                    .containsExactlyInAnyOrder("answers.png", "3.1-position-thesis-2.png", "3.1-rotation-thesis-2.png", "3.2-spines-thesis-2.png",
                            "3.3-envelopes-thesis-2.png", "3.4-scaled-thesis-2.png", "3.5-flow-thesis-2.png", "3.6-flow-thesis-2.png");
        }
        assertThat(Files.readString(folder.resolve("report.html"))).contains("data:image/png;base64,");
    }

    /** A parameter's standard value is the scene's own: setting it changes no bit. */
    @Test
    void theStandardValueOfEveryParameterIsTheScenesOwn() throws InterruptedException {
        ExecutionSettings execution = new ExecutionSettings(SIMULATOR, 1, Duration.ofMinutes(5)).withMode(SimulatorMode.RESIDENT);
        try (Evaluator evaluator = Evaluator.open(execution)) {
            for (Water water : Water.values()) {
                SimulationRequest plain = Condition.WATER.of(Subject.of(data.gait("1"), water), 0.04);
                String own = evaluator.evaluate(plain).hash();
                for (Parameter parameter : Parameter.values()) {
                    if (parameter.in(water).isPresent()) {
                        Parameter.Range range = parameter.in(water).get();
                        assertThat(range.values()).as(parameter.label()).contains(range.standard()).isSorted().doesNotHaveDuplicates();
                        assertThat(evaluator.evaluate(plain.withChange(parameter.overrides(range.standard()))).hash())
                                .as(parameter.label() + " in " + water.label()).isEqualTo(own);
                    }
                }
            }
        }
    }

    @Test
    void everyExtremeIsOneThatTheSimulatorTakes() throws InterruptedException {
        for (Water water : Water.values()) {
            for (Parameter parameter : Parameter.values()) {
                for (double extreme : parameter.in(water).map(range -> List.of(range.values().get(0),
                        range.values().get(range.values().size() - 1))).orElse(List.of())) {
                    assertThat(SceneInfo.of(water.scene(1), parameter.overrides(extreme), SIMULATOR).particles())
                            .as(parameter.label() + " " + extreme + " in " + water.label()).isGreaterThan(5000);
                }
            }
        }
    }

    @Test
    void theThesisDataAreThoseOfTheThesis() {
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

    /** What is said to be from a file is in it, and there are no other files to look for. */
    @Test
    void theNumbersOfFlexAreThoseOfTheFileThatIsNamed() throws IOException {
        String about = String.join(" ", data.about());
        List<String> files = Pattern.compile("[\\w.-]+/[\\w./-]+").matcher(about).results().map(MatchResult::group).toList();
        assertThat(files).containsExactly("tests/conformance/variants/variants.csv");
        List<List<String>> rows = Files.readAllLines(Path.of("../..").resolve(files.get(0))).stream().map(line -> List.of(line.split(",", -1))).toList();
        int speed = rows.get(0).indexOf("v_0_4");

        for (ThesisData.FlexSpeed flex : data.gaits().stream().flatMap(gait -> gait.flex().stream()).toList()) {
            Sample runs = Sample.of(rows.stream().filter(row -> row.get(0).matches(flex.runs())).map(row -> Double.valueOf(row.get(speed))).toList());
            assertThat(runs.mean()).as(flex.runs()).isCloseTo(flex.mean(), within(5e-7));
            if (flex.deviation() != null) {
                assertThat(runs.standardDeviation()).as(flex.runs()).isCloseTo(flex.deviation(), within(1e-6));
            }
        }
    }
}
