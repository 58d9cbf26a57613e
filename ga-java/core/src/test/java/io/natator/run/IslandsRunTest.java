package io.natator.run;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.checkpoint.Archipelago;
import io.natator.checkpoint.Leader;
import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.StoredRun;
import io.natator.config.Backend;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Judge;
import io.natator.config.OptimizerKind;
import io.natator.evolution.Departure;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.Individual;
import io.natator.evolution.Migrant;
import io.natator.evolution.ToySimulator;
import io.natator.file.JsonLines;
import io.natator.simulator.Evaluator;
import io.natator.simulator.FakeSimulator;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import io.natator.simulator.WorkerPool;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.HashSet;
import java.util.List;
import java.util.Random;
import java.util.Set;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Consumer;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

@Timeout(value = 10, unit = TimeUnit.MINUTES)
class IslandsRunTest {

    private static final EvolutionSettings SETTINGS =
            EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2).withSize(12, 9).withSeed(3);
    private static final List<String> FILES =
            List.of("config.json", "generations.csv", "best.json", "checkpoint.json", "evaluations.jsonl");

    @TempDir
    private Path folder;
    private ExecutionSettings execution;

    @BeforeEach
    void fake() {
        execution = new ExecutionSettings(FakeSimulator.in(folder), 2, Duration.ofMinutes(5));
    }

    /** Counts nothing, tells nothing. */
    private static class Silent implements RunQueue.Watcher {
        @Override
        public void evaluated() {
            // Not of interest.
        }

        @Override
        public void finished(RunFolder run, EvolutionRun.Outcome outcome) {
            // Likewise.
        }

        @Override
        public EvolutionListener forRun() {
            return new EvolutionListener() { };
        }
    }

    private Archipelago create(String name, Archipelago.Plan plan) {
        return Archipelago.create(folder.resolve(name), plan);
    }

    private boolean run(Archipelago archipelago, Evaluator evaluator) throws InterruptedException {
        try (evaluator) {
            return new IslandsRun(archipelago).run(execution, evaluator, new Silent());
        }
    }

    private Archipelago whole(String name, Archipelago.Plan plan) throws InterruptedException {
        Archipelago archipelago = create(name, plan);
        assertThat(run(archipelago, new WorkerPool(new ToySimulator(), 2))).isTrue();
        return archipelago;
    }

    /** Holds up some callers at random, so that islands overtake each other. */
    private static Evaluator uneven(long seed) {
        Random random = new Random(seed);
        WorkerPool pool = new WorkerPool(new ToySimulator(), 3);
        return new Evaluator() {
            @Override
            public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
                    throws InterruptedException {
                Thread.sleep(random.nextInt(4) == 0 ? random.nextInt(60) : 0);
                pool.evaluateAll(requests, whenDone);
            }

            @Override
            public void close() {
                pool.close();
            }
        };
    }

    private static void assertSame(Archipelago one, Archipelago other) {
        for (int i = 1; i <= other.plan().islands(); i++) {
            for (String file : FILES) {
                assertThat(one.folder(i).resolve(file)).hasSameBinaryContentAs(other.folder(i).resolve(file));
            }
            if (other.plan().migrants() > 0) {
                assertThat(one.folder(i).resolve("migrants.jsonl"))
                        .hasSameBinaryContentAs(other.folder(i).resolve("migrants.jsonl"));
            }
        }
    }

    @Test
    void whoIsFasterChangesNoByte() throws InterruptedException {
        Archipelago.Plan plan = new Archipelago.Plan(SETTINGS, 4, 2, 3);
        Archipelago first = whole("first", plan);
        for (int seed = 0; seed < 5; seed++) {
            Archipelago other = create("other-" + seed, plan);
            assertThat(run(other, uneven(seed))).isTrue();

            assertSame(other, first);
        }
    }

    @Test
    void withoutMigrantsAnIslandIsThePlainRunOfItsSeed() throws InterruptedException {
        Archipelago alone = whole("alone", new Archipelago.Plan(SETTINGS, 3, 2, 0));
        for (int i = 1; i <= 3; i++) {
            Path plain = folder.resolve("plain-" + i);
            try (RunFolder run = RunFolder.create(plain, SETTINGS.withSeed(2 + i));
                    Evaluator evaluator = new WorkerPool(new ToySimulator(), 2)) {
                new EvolutionRun(run).run(execution, evaluator);
            }
            for (String file : FILES) {
                assertThat(alone.folder(i).resolve(file)).hasSameBinaryContentAs(plain.resolve(file));
            }
            assertThat(alone.folder(i).resolve("migrants.jsonl")).doesNotExist();
        }
    }

    /** Up to the first exchange a connected island is the plain run, too; after it, no longer. */
    @Test
    void migrantsAreTheBestAndBreedWhereTheyCome() throws InterruptedException {
        Archipelago ring = whole("ring", new Archipelago.Plan(SETTINGS, 3, 4, 3));
        Archipelago alone = whole("alone", new Archipelago.Plan(SETTINGS, 3, 4, 0));
        for (int i = 1; i <= 3; i++) {
            Path island = ring.folder(i);
            Path before = ring.folder(i == 1 ? 3 : i - 1);
            List<EvaluationRecord> own = StoredRun.recorded(island).rows();
            List<EvaluationRecord> plain = StoredRun.recorded(alone.folder(i)).rows();
            int common = (int) plain.stream().filter(one -> one.generation() <= 4).count();
            assertThat(own.subList(0, common)).isEqualTo(plain.subList(0, common));
            assertThat(genes(own, 5)).isNotEqualTo(genes(plain, 5));

            List<Departure> left = StoredRun.departures(before);
            assertThat(left).extracting(Departure::generation).containsExactly(4, 8);
            List<Double> best = StoredRun.recorded(before).rows().stream().filter(one -> one.generation() <= 4)
                    .map(one -> one.result().score()).sorted((a, b) -> Double.compare(b, a)).distinct().limit(2).toList();
            assertThat(left.get(0).migrants()).hasSize(3).extracting(one -> one.individual().score()).startsWith(best.toArray(Double[]::new));
            assertThat(left.get(0).migrants()).extracting(Migrant::born).containsOnly(i == 1 ? 3 : i - 1);
        }
        // Gene values that no other island can have come to by itself, in children of the next generation.
        int mixed = 0;
        for (int i = 1; i <= 3; i++) {
            Set<Double> strange = new HashSet<>();
            StoredRun.departures(ring.folder(i == 1 ? 3 : i - 1)).get(0).migrants()
                    .forEach(one -> strange.addAll(one.individual().genes()));
            mixed += children(ring.folder(i), strange);
            assertThat(children(alone.folder(i), strange)).isZero();
        }
        assertThat(mixed).isPositive();
    }

    private static int children(Path island, Set<Double> genes) {
        return (int) StoredRun.recorded(island).rows().stream().filter(one -> one.generation() == 5
                && one.genes().stream().anyMatch(genes::contains)).count();
    }

    private static List<List<Double>> genes(List<EvaluationRecord> evaluations, int generation) {
        return evaluations.stream().filter(one -> one.generation() == generation).map(EvaluationRecord::genes).toList();
    }

    /** In the first state after an exchange the immigrants that were selected are there as they came, evaluated elsewhere. */
    @ParameterizedTest
    @ValueSource(ints = {1, 3})
    void whoCameIsJudgedWhereItWasBorn(int starts) throws InterruptedException {
        Archipelago ring = whole("ring", new Archipelago.Plan(SETTINGS.withStarts(starts, Judge.MEAN), 3, 4, 3));
        int strangers = 0;
        for (int i = 1; i <= 3; i++) {
            StoredRun run = StoredRun.in(ring.folder(i));
            Set<List<Double>> own = new HashSet<>();
            run.evaluations().forEach(one -> own.add(one.genes()));
            assertThat(own).contains(run.best().genes());
            List<Leader> leaders = run.leaders();
            if (starts == 1) {
                assertThat(leaders.get(leaders.size() - 1).genes()).isEqualTo(run.best().genes());
            }
            Set<List<Double>> came = new HashSet<>();
            for (Departure one : StoredRun.departures(ring.folder(i == 1 ? 3 : i - 1))) {
                one.migrants().stream().filter(migrant -> !own.contains(migrant.individual().genes()))
                        .forEach(migrant -> came.add(migrant.individual().genes()));
            }
            List<Individual> present = run.state().population().stream().filter(one -> came.contains(one.genes())).toList();
            assertThat(run.state().population()).allMatch(one -> own.contains(one.genes()) || came.contains(one.genes()));
            strangers += present.size();
        }
        assertThat(strangers).isPositive();
    }

    @Test
    void theWinnerIsTheBestOfAllIslands() throws InterruptedException {
        Archipelago ring = whole("ring", new Archipelago.Plan(SETTINGS, 4, 4, 1));
        double best = Double.NEGATIVE_INFINITY;
        int winner = 0;
        for (int i = 1; i <= 4; i++) {
            double own = StoredRun.best(ring.folder(i)).selected();
            winner = own > best ? i : winner;
            best = Math.max(best, own);
        }

        assertThat(ring.winner()).isEqualTo(winner);
        assertThat(Archipelago.run(ring.directory())).isEqualTo(ring.folder(winner));
        assertThat(Archipelago.runs(List.of(ring.directory()))).hasSize(4).first().isEqualTo(ring.folder(winner));
        assertThat(Archipelago.run(ring.folder(2))).isEqualTo(ring.folder(2));
    }

    /** Stops at every so many evaluations, as if all threads were killed there. */
    @ParameterizedTest
    @CsvSource({"1, 41", "1, 57", "3, 113"})
    void stopsChangeNothing(int starts, int step) throws InterruptedException {
        Archipelago.Plan plan = new Archipelago.Plan(SETTINGS.withStarts(starts, Judge.MEAN), 3, 2, 2);
        Archipelago first = whole("whole", plan);
        Archipelago stopped = create("stopped", plan);
        int stops = 0;
        for (boolean done = false; !done; stops++) {
            AtomicInteger left = new AtomicInteger(step);
            WorkerPool pool = new WorkerPool(new ToySimulator(), 2);
            try (pool) {
                done = new IslandsRun(Archipelago.in(stopped.directory())).run(execution, pool, new Silent() {
                    @Override
                    public void evaluated() {
                        if (left.decrementAndGet() == 0) {
                            pool.close();
                        }
                    }
                });
            }
        }

        assertThat(stops).isGreaterThan(8);
        assertSame(stopped, first);
    }

    /** What is there when the last thing that was written is the checkpoint, or half a line of who left. */
    @ParameterizedTest
    @CsvSource({"0", "0.5", "1"})
    void aKillBetweenCheckpointAndDepartureChangesNothing(double kept) throws InterruptedException, IOException {
        Archipelago.Plan plan = new Archipelago.Plan(SETTINGS, 3, 2, 2);
        Archipelago first = whole("whole", plan);
        Archipelago killed = create("killed", plan);
        WorkerPool pool = new WorkerPool(new ToySimulator(), 2);
        try (pool) {
            new IslandsRun(killed).run(execution, pool, new Silent() {
                @Override
                public EvolutionListener forRun() {
                    return new EvolutionListener() {
                        @Override
                        public void generationFinished(EvolutionState state) {
                            if (state.generation() == 4) {
                                pool.close();
                            }
                        }
                    };
                }
            });
        }
        int cut = 0;
        for (int i = 1; i <= 3; i++) {
            Path migrants = killed.folder(i).resolve("migrants.jsonl");
            List<Departure> rows = JsonLines.read(migrants, Departure.class);
            if (StoredRun.state(killed.folder(i)).generation() == 4 && rows.size() == 2) {
                String text = Files.readString(migrants);
                int second = text.indexOf('\n') + 1;
                Files.writeString(migrants, text.substring(0, second + (int) (kept * (text.length() - second))));
                cut++;
            }
        }
        assertThat(cut).isPositive();

        assertThat(run(killed, new WorkerPool(new ToySimulator(), 2))).isTrue();
        assertSame(killed, first);
    }

    /** Islands that have used up their evaluations send nobody any more; nobody waits for them. */
    @Test
    void islandsMayEndInDifferentGenerations() throws InterruptedException {
        Archipelago.Plan plan = new Archipelago.Plan(SETTINGS.withSize(12, 60).withEvaluations(600L), 6, 1, 2);
        Archipelago first = whole("first", plan);
        Archipelago other = create("other", plan);
        assertThat(run(other, uneven(1))).isTrue();

        assertSame(other, first);
        assertThat(first.folders().stream().map(one -> StoredRun.state(one).generation()).distinct().toList()).hasSizeGreaterThan(1);
        assertThat(first.folders()).allMatch(one -> StoredRun.recorded(one).rows().size() == 600);
    }

    @Test
    void anIslandDoesNotGoOnAlone() throws InterruptedException {
        Archipelago ring = whole("ring", new Archipelago.Plan(SETTINGS, 3, 4, 3));
        try (RunFolder island = RunFolder.open(ring.folder(2)); Evaluator evaluator = new WorkerPool(new ToySimulator(), 1)) {
            assertThatThrownBy(() -> new EvolutionRun(island).run(execution, evaluator)).isInstanceOf(InvalidInputException.class)
                    .hasMessage(ring.folder(2) + " is one of 3 islands, which go on together; expected the folder that they are in");
        }
    }

    /** What the third cannot do leaves the first two as they are. */
    @Test
    void allAreCheckedBeforeOneIsChanged() throws InterruptedException, IOException {
        Archipelago archipelago = whole("run", new Archipelago.Plan(SETTINGS.withSize(8, 2), 3, 1, 1));
        Path third = archipelago.folder(3).resolve("config.json");
        Files.writeString(third, Files.readString(third).replace("\"seed\" : 5", "\"seed\" : 55"));
        Archipelago extended = archipelago.withGenerations(4);

        assertThatThrownBy(() -> IslandsRun.change(extended)).isInstanceOf(InvalidInputException.class)
                .hasMessageStartingWith(third + " was edited after the run was begun: seed was 5, is now 55; ");
        assertThat(Archipelago.in(archipelago.directory())).isEqualTo(archipelago);
        extended.withBackend(Backend.AUTO).write();
        assertThatThrownBy(() -> run(Archipelago.in(archipelago.directory()), new WorkerPool(new ToySimulator(), 2)))
                .isInstanceOf(InvalidInputException.class);
        for (int i = 1; i <= 2; i++) {
            assertThat(StoredRun.settings(archipelago.folder(i))).isEqualTo(archipelago.plan().settings(i));
        }
    }

    @Test
    void whoLeftMustBeKnown() throws InterruptedException, IOException {
        Archipelago ring = whole("ring", new Archipelago.Plan(SETTINGS, 3, 4, 3));
        Files.delete(ring.folder(2).resolve("migrants.jsonl"));

        assertThatThrownBy(() -> RunFolder.open(ring.folder(2))).isInstanceOf(InvalidInputException.class)
                .hasMessage(ring.folder(2) + " is damaged: migrants.jsonl has 0 whole lines; expected at least 2, one for each "
                        + "exchange before generation 9");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
        "JGAP | 1 | 2 | 3 | islands are 1; expected a whole number from 2 to 1024",
        "JGAP | 3 | 0 | 3 | generations between exchanges are 0; expected a whole number from 1",
        "JGAP | 3 | 2 | -1 | migrants are -1; expected a whole number from 0",
        "JGAP | 3 | 2 | 12 | migrants are 12; expected fewer than the population, 12",
        "JGAP | 3 | 9 | 2 | generations between exchanges are 9; expected fewer than the run's 9, or no migrants",
        "CMA_ES | 3 | 2 | 2 | optimizer cma-es takes no migrants; expected jgap, or islands without migrants",
        "RANDOM | 3 | 2 | 2 | optimizer random takes no migrants; expected jgap, or islands without migrants"})
    void whatCannotBeIsRefused(OptimizerKind optimizer, int islands, int every, int migrants, String message) {
        assertThatThrownBy(() -> new Archipelago.Plan(SETTINGS.withOptimizer(optimizer, SETTINGS.operators(),
                SETTINGS.gaussianDeviation()), islands, every, migrants))
                .isInstanceOf(InvalidInputException.class).hasMessage(message);
    }
}
