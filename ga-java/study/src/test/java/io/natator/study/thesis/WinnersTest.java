package io.natator.study.thesis;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.evolution.ToySimulator;
import io.natator.run.PlannedRun;
import io.natator.simulator.Evaluator;
import io.natator.simulator.FakeSimulator;
import io.natator.simulator.SimulationResult;
import io.natator.simulator.WorkerPool;
import io.natator.verdict.Verdict;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Supplier;
import java.util.stream.Stream;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Who wins, and what is said of it, with swimmers that swim by a formula and luck. */
class WinnersTest {

    private static final double DURATION = 4;
    private static final Gait LUCKY = gait(0.5);
    private static final Gait GOOD = gait(1.2);

    @TempDir
    private Path folder;
    private final ThesisData data = ThesisData.load();
    private final ExperimentCatalogue catalogue = new ExperimentCatalogue(data, null, 4);
    private final List<Integer> rounds = new ArrayList<>();
    private final AtomicInteger done = new AtomicInteger();
    private EvolvedRun run;

    private static Gait gait(double frequency) {
        return new Gait(frequency, List.of(0.6, 0.6), List.of(0.0, 0.3));
    }

    /** What evolution took for the best is worse than another of its finalists. */
    @BeforeEach
    void evolve() throws IOException {
        Path directory = folder.resolve("runs/creature-1/flex/seed-1");
        Files.createDirectories(directory);
        Files.writeString(directory.resolve("finalists.json"), Json.document(new Finalists(List.of(new Finalists.Finalist(LUCKY, 2.9, 1),
                new Finalists.Finalist(GOOD, 0.8, 5)), 3)));
        run = new EvolvedRun(1, Water.FLEX, 1, new PlannedRun(EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2), directory));
    }

    private void measure(MeasurementLog log, List<Experiment> experiments) throws IOException, InterruptedException {
        measure(log, () -> experiments);
    }

    private void measure(MeasurementLog log, Supplier<List<Experiment>> experiments) throws IOException, InterruptedException {
        Path fake = folder.resolve("fake-simulator.sh");
        ExecutionSettings execution = new ExecutionSettings(Files.exists(fake) ? fake : FakeSimulator.in(folder), 2, Duration.ofMinutes(1));
        try (Evaluator evaluator = new WorkerPool(new ToySimulator(), 2)) {
            log.measureAll(experiments, evaluator, execution, rounds::add, done::incrementAndGet);
        }
    }

    /** As many runs of the winner as there were of finalists: the number of those that are missing stays the same. */
    @Test
    void whatAFirstRoundHasFoundIsMeasuredInASecond() throws IOException, InterruptedException {
        try (MeasurementLog log = new MeasurementLog(folder.resolve("measurements.jsonl"))) {
            Winners winners = new Winners(folder, catalogue, log, List.of(run));
            Supplier<List<Experiment>> known = () -> Stream.concat(winners.experiments().stream(), winners.all().stream()
                    .flatMap(winner -> Stream.of(Condition.WATER, Condition.VACUUM).map(condition -> catalogue.of(winner, condition)))).toList();
            assertThat(winners.experiments()).hasSize(2);

            measure(log, known);

            assertThat(known.get()).hasSize(4).allMatch(log::has);
            assertThat(rounds).containsExactly(8, 8);
            assertThat(done).hasValue(16);
        }
    }

    @Test
    void theWinnerIsWhoGoesFurthestFromStartsThatEvolutionDidNotHave() throws IOException, InterruptedException {
        try (MeasurementLog log = new MeasurementLog(folder.resolve("measurements.jsonl"))) {
            Winners winners = new Winners(folder, catalogue, log, List.of(run));
            measure(log, winners.experiments().subList(0, 1));
            assertThat(winners.all()).as("with a finalist missing").isEmpty();

            measure(log, winners.experiments());

            assertThat(winners.all()).singleElement().satisfies(winner -> {
                assertThat(winner.gait()).isEqualTo(GOOD);
                assertThat(winner.name()).isEqualTo("runs/creature-1/flex/seed-1");
                assertThat(winner.isEvolved()).isTrue();
            });
            assertThat(winners.experiments()).flatExtracting(one -> one.runs().stream().map(request -> request.start()).toList())
                    .doesNotContainAnyElementsOf(catalogue.of(winners.all().get(0), Condition.WATER).runs().stream()
                            .map(request -> request.start()).toList());
        }
    }

    /** The formula does not know muscles at rest, so what rests swims worse only by its amplitudes; vacuum it knows. */
    @Test
    void aWinnerIsJudgedByAllControls() throws IOException, InterruptedException {
        try (StudyResults results = OpenStudy.of(folder, catalogue, List.of(run))) {
            MeasurementLog log = results.measurements();
            MeasurementLog processor = results.processor();
            Winners winners = results.winners();
            measure(log, winners.experiments());
            assertThat(results.verdict(winners.all().get(0))).as("nothing but finalists measured").isEmpty();

            measure(log, results.experiments());
            measure(log, results.experiments());

            Subject winner = winners.all().get(0);
            assertThat(results.best(1, Water.FLEX)).isEqualTo(Optional.of(winner));
            assertThat(results.best(2, Water.FLEX)).isEmpty();
            assertThat(results.studied(Water.FLEX)).hasSize(2).contains(winner);
            assertThat(results.speed(winner, Condition.VACUUM).mean()).isCloseTo(0.2 / DURATION, within(1e-9));
            assertThat(results.speed(winner, Condition.WATER).mean()).isCloseTo(0.5 / DURATION, within(0.1));
            assertThat(results.controls(winner).orElseThrow().clampOff()).isNotNull();
            assertThat(results.verdict(winner).orElseThrow().kind()).isNotEqualTo(Verdict.Kind.DOES_NOT_SWIM);
            assertThat(results.measurements().missing(results.experiments())).isEmpty();

            measure(processor, results.onProcessor());
            assertThat(processor.isOnGpu(catalogue.of(winner, Condition.WATER))).isFalse();
            assertThat(results.controls(winner).orElseThrow().otherBackend())
                    .as("measured on the processor both times, which is no other backend").isNull();
        }
    }

    /** In the thesis' tank a wall is part of the scene, in open water it is where the scene ends. */
    @Test
    void onlyInOpenWaterAWayIsDividedByTheTimeUntilAWall() throws IOException, InterruptedException {
        Path file = folder.resolve("measurements.jsonl");
        Subject inTank = ExperimentCatalogue.subject(run, GOOD, folder);
        List<Experiment> swims = Stream.of(Condition.WATER, Condition.OTHER_WATER).map(condition -> catalogue.of(inTank, condition)).toList();
        try (MeasurementLog log = new MeasurementLog(file)) {
            measure(log, swims);
        }
        Files.writeString(file, Files.readString(file).replace("\"simulated\":4.0", "\"simulated\":2.0"));

        try (StudyResults results = OpenStudy.of(folder, catalogue, List.of(run))) {
            MeasurementLog log = results.measurements();
            assertThat(results.speed(inTank, Condition.WATER).mean()).isCloseTo(meanWay(log, swims.get(0)) / DURATION, within(1e-12));
            assertThat(results.speed(inTank, Condition.OTHER_WATER).mean()).isCloseTo(meanWay(log, swims.get(1)) / 2, within(1e-12));
            assertThat(results.lasted(inTank).mean()).isEqualTo(2);
        }
    }

    private static double meanWay(MeasurementLog log, Experiment experiment) {
        return log.results(experiment).stream().mapToDouble(SimulationResult::distance).average().orElseThrow();
    }

    @Test
    void theProcessorIsAnotherBackendForWhatAGpuMeasured() throws IOException, InterruptedException {
        Path file = folder.resolve("measurements.jsonl");
        Experiment swim;
        try (MeasurementLog log = new MeasurementLog(file)) {
            swim = new Winners(folder, catalogue, log, List.of(run)).experiments().get(0);
            measure(log, List.of(swim));
            assertThat(log.isOnGpu(swim)).isFalse();
        }
        Files.writeString(file, Files.readString(file).replace("\"backend\":\"cpu\"", "\"backend\":\"cuda\""));

        try (MeasurementLog log = new MeasurementLog(file)) {
            assertThat(log.isOnGpu(swim)).isTrue();
        }
    }

    @Test
    void conditionsChangeWhatTheyAreNamedAfterAndNothingElse() {
        Subject subject = ExperimentCatalogue.subject(run, GOOD, folder);

        assertThat(Condition.RESTING.of(subject, null).gait().amplitude()).containsOnly(0.0);
        assertThat(Condition.HALF_STEP.of(subject, null).overrides().at("/solver/substeps").intValue()).isEqualTo(8);
        assertThat(Condition.NO_CLAMP.of(subject, null).overrides().at("/solver/maxAcceleration").doubleValue()).isGreaterThan(1e38);
        assertThat(Condition.OTHER_WATER.of(subject, null).scene()).isEqualTo("open-water/creature-1");
        assertThat(Condition.VACUUM.of(subject, null).overrides().get("fluid").isNull()).isTrue();
        assertThat(Condition.WATER.of(subject, null).overrides().at("/stopping/planeContact").booleanValue()).isTrue();
        assertThat(Condition.WATER.of(Subject.of(data.gait("1"), Water.FLEX), null).overrides().at("/stopping/planeContact").booleanValue())
                .as("a published gait runs on, as it did with Flex").isFalse();
        assertThat(Condition.in(Water.OPEN_WATER)).doesNotContain(Condition.NO_CLAMP, Condition.INVERSE_MASS);
    }
}
