package io.natator.run;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.natator.base.InvalidInputException;
import io.natator.cache.CachedEvaluator;
import io.natator.cache.EvaluationCache;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.EvaluationStatistics;
import io.natator.checkpoint.RunFiles;
import io.natator.checkpoint.RunReader;
import io.natator.checkpoint.RunWriter;
import io.natator.checkpoint.VacuumRecord;
import io.natator.config.Aggregate;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.FitnessKind;
import io.natator.config.Json;
import io.natator.config.OptimizerKind;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.Individual;
import io.natator.evolution.ToyEvolution;
import io.natator.evolution.ToySimulator;
import io.natator.process.Evaluator;
import io.natator.process.FakePool;
import io.natator.process.FakeSimulator;
import io.natator.protocol.SimulationResult;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.stream.Collectors;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class EvolutionRunTest {

    private static final EvolutionSettings SETTINGS = EvolutionSettings.of("thesis/creature-3", EncodingKind.DENSE, 5)
            .withSize(12, 5).withSeed(3);

    @TempDir
    private Path folder;
    private ExecutionSettings execution;

    @BeforeEach
    void fake() {
        execution = FakeSimulator.execution(folder);
    }

    /** Runs in a folder of this name; gives the number of simulations. */
    private int run(String name, EvolutionSettings settings, ExecutionSettings how) throws InterruptedException {
        ToySimulator simulator = new ToySimulator();
        try (RunWriter run = RunWriter.create(folder.resolve(name), settings);
                Evaluator inner = new FakePool(simulator, 2);
                Evaluator evaluator = how.cache() == null ? inner
                        : new CachedEvaluator(inner, new EvaluationCache(how.cache()), how)) {
            new EvolutionRun(run).run(how, evaluator);
        }
        return simulator.calls();
    }

    private void finish(RunWriter run, FakePool.Simulation simulator, EvolutionListener... listeners)
            throws InterruptedException {
        try (run; Evaluator evaluator = new FakePool(simulator, 2)) {
            new EvolutionRun(run).run(execution, evaluator, listeners);
        }
    }

    private void assertSame(String one, String other) {
        RunFiles.assertSame(folder.resolve(one), folder.resolve(other));
    }

    @Test
    void theCacheSavesEvaluationsAndChangesNoByte() throws InterruptedException {
        ExecutionSettings cached = execution.withCache(folder.resolve("cache"));

        int without = run("without", SETTINGS, execution);
        int first = run("first", SETTINGS, cached);
        int second = run("second", SETTINGS, cached);
        int longer = run("longer", SETTINGS.withSize(12, 6), cached);

        assertThat(first).isEqualTo(without);
        assertThat(second).isZero();
        assertThat(longer).isBetween(1, without / 4);
        assertSame("first", "without");
        assertSame("second", "without");
        assertThat(RunReader.statistics(folder.resolve("without")).fromCache()).isZero();
        EvaluationStatistics statistics = RunReader.statistics(folder.resolve("second"));
        assertThat(statistics.fromCache()).isEqualTo(statistics.evaluations()).isEqualTo(without - 1 - 2 * 4);
    }

    @Test
    void damagedEntriesAreSimulatedAnew() throws InterruptedException, IOException {
        ExecutionSettings cached = execution.withCache(folder.resolve("cache"));
        int all = run("first", SETTINGS, cached);
        int damaged = 0;
        try (var files = Files.walk(folder.resolve("cache"))) {
            for (Path file : files.filter(Files::isRegularFile).limit(7).toList()) {
                Files.writeString(file, damaged++ % 2 == 0 ? "" : Files.readString(file).replace("ok", "no"));
            }
        }

        assertThat(run("second", SETTINGS, cached)).isEqualTo(7).isLessThan(all);
        assertSame("second", "first");
    }

    /** Counted in another way: from what was recorded of each generation. A run that goes on from its middle counts the same. */
    @ParameterizedTest
    @CsvSource({"MAP_ELITES, 1", "MAP_ELITES, 2", "JGAP, 1", "JGAP, 2", "RANDOM, 1", "CMA_ES, 2", "NSGA2, 1"})
    void unchangedIsWhatWasNotNewlySimulated(OptimizerKind optimizer, int starts)
            throws InterruptedException, IOException {
        EvolutionSettings settings = ToyEvolution.by(optimizer, SETTINGS.withStarts(starts, Aggregate.MEAN));
        ToyEvolution.Recorder recorder = new ToyEvolution.Recorder();
        finish(RunWriter.create(folder.resolve("run"), settings), new ToySimulator(), recorder);

        Set<List<Double>> known = new HashSet<>();
        long unchanged = 0;
        for (EvolutionState state : recorder.states) {
            Set<List<Double>> born = evaluations("run").stream().filter(one -> one.generation() == state.generation())
                    .map(EvaluationRecord::genes).filter(genes -> !known.contains(genes)).collect(Collectors.toSet());
            unchanged += state.population().size() - state.population().stream().map(Individual::genes).distinct()
                    .filter(born::contains).count();
            known.addAll(born);
        }
        EvaluationStatistics statistics = RunReader.statistics(folder.resolve("run"));
        assertThat(statistics.unchanged()).isEqualTo(unchanged).isGreaterThanOrEqualTo(0);
        assertThat(statistics.evaluations()).isEqualTo(recorder.evaluations.size());
        assertThat(statistics.wholeSeconds()).isEqualTo(4.0 * recorder.evaluations.size());

        String whole = Files.readString(folder.resolve("run/savings.json"));
        Files.writeString(folder.resolve("run/checkpoint.json"), Json.document(recorder.states.get(2)));
        Files.delete(folder.resolve("run/digests.json"));  // else it is noticed
        finish(RunWriter.open(folder.resolve("run")), new ToySimulator());
        assertThat(folder.resolve("run/savings.json")).hasContent(whole);
    }

    /** Sums of 0.1 s are not whole multiples of it, and a body that is none is no saved time. */
    @Test
    void nothingIsSavedWhereNothingEndsEarly() throws InterruptedException {
        run("short", SETTINGS.withScene(null, 0.1, null), execution);

        EvaluationStatistics statistics = RunReader.statistics(folder.resolve("short"));
        assertThat(statistics.simulatedSeconds()).isEqualTo(statistics.wholeSeconds());
        assertThat(statistics.shareOfEarlyStops()).isEqualTo(0.0);
        assertThat(new EvaluationStatistics(30, 0, 0, 0, 3.0000000000000004, 3, 0).shareOfEarlyStops()).isEqualTo(0.0);
    }

    /** A stop with the last frame saves nothing; frames are what a duration is rounded to. */
    @ParameterizedTest
    @CsvSource({"4.0, 4.0, 240, false", "4.0, 3.9833, 239, true", "0.11, 0.1166667, 7, false", "0.11, 0.1, 6, true",
            "0.108, 0.1, 6, false"})
    void onlyWhatWasNotSimulatedWholeEndedEarly(double duration, double simulated, int frames, boolean early)
            throws InterruptedException {
        ToySimulator toy = new ToySimulator();
        FakePool.Simulation stopped = request -> toy.evaluate(request)
                .with(to -> to.stopped("no-progress").simulated(simulated).frames(frames));
        finish(RunWriter.create(folder.resolve("run"), SETTINGS.withScene(null, duration, null)), stopped);

        EvaluationStatistics statistics = RunReader.statistics(folder.resolve("run"));
        assertThat(statistics.stoppedEarly()).isEqualTo(early ? statistics.simulations() : 0);
        assertThat(statistics.shareOfEarlyStops()).isCloseTo(early ? 1 - simulated / duration : 0, within(1e-9));
    }

    private List<EvaluationRecord> evaluations(String name) {
        return RunReader.recorded(folder.resolve(name)).rows();
    }

    /** The toy swims best at f = 1.2, where it drifts 0.2 in vacuum: no more than what remains is to count. */
    @Test
    void netFitnessTakesAwayWhatIsNoSwimming() throws InterruptedException {
        EvolutionSettings plain = SETTINGS.withSize(40, 15);
        run("plain", plain, execution);
        run("net", plain.withFitness(FitnessKind.NET, false), execution);

        for (EvaluationRecord evaluation : evaluations("net")) {
            SimulationResult result = evaluation.result();
            double drift = evaluation.gait().frequency() - 1.0;
            if (result.distance() > 0) {
                assertThat(result.vacuumDrift()).isEqualTo(drift);
                assertThat(result.score()).isEqualTo(result.distance() - Math.max(drift, 0));
            } else {
                assertThat(result.vacuumDrift()).isNull();
                assertThat(result.score()).isEqualTo(result.distance());
            }
        }
        BestGait cheating = Json.read(folder.resolve("plain/best.json"), BestGait.class, "best");
        BestGait honest = Json.read(folder.resolve("net/best.json"), BestGait.class, "best");
        assertThat(cheating.gait().frequency()).isBetween(1.1, 1.3);
        assertThat(honest.gait().frequency()).isBetween(0.85, 1.05);
        assertThat(cheating.vacuum().distance()).isPositive();
    }

    @Test
    void vacuumChecksAreRecordedOncePerNewBest() throws InterruptedException, IOException {
        run("run", SETTINGS.withSize(20, 10).withFitness(FitnessKind.DISTANCE, true), execution);
        run("without", SETTINGS, execution);

        List<VacuumRecord> records = RunReader.vacuumRecords(folder.resolve("run"));
        List<EvaluationRecord> evaluations = evaluations("run");
        double best = Double.NEGATIVE_INFINITY;
        List<Long> newBests = new ArrayList<>();
        for (int generation = 0; generation <= 10; generation++) {
            int number = generation;
            EvaluationRecord candidate = evaluations.stream().filter(one -> one.generation() == number)
                    .max(Comparator.comparingDouble(one -> one.result().distance())).orElseThrow();
            if (candidate.result().distance() > best) {
                best = candidate.result().distance();
                newBests.add(candidate.result().id());
            }
        }
        assertThat(records).extracting(VacuumRecord::evaluation).isEqualTo(newBests).hasSizeGreaterThan(1);
        assertThat(records).allSatisfy(record -> assertThat(record.drift())
                .isEqualTo(evaluations.get((int) record.evaluation()).gait().frequency() - 1.0));
        assertThat(RunReader.vacuumRecords(folder.resolve("without"))).isEmpty();

        String before = Files.readString(folder.resolve("run/vacuum.jsonl"));
        Files.delete(folder.resolve("run/vacuum.jsonl"));
        assertThatThrownBy(() -> RunWriter.open(folder.resolve("run"))).isInstanceOf(InvalidInputException.class)
                .hasMessageStartingWith(folder.resolve("run") + " is damaged: it has no vacuum.jsonl");
        Files.delete(folder.resolve("run/digests.json"));
        finish(RunWriter.open(folder.resolve("run")), new ToySimulator());
        assertThat(before).endsWith(Files.readString(folder.resolve("run/vacuum.jsonl")));
    }
}
