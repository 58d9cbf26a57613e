package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.checkpoint.GaitRanking;
import io.natator.config.Aggregate;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.FitnessKind;
import io.natator.config.Json;
import io.natator.config.OptimizerKind;
import io.natator.encoding.Gait;
import io.natator.fitness.FitnessEvaluator;
import io.natator.process.Evaluator;
import io.natator.process.FakePool;
import io.natator.protocol.Effort;
import io.natator.protocol.Results;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Instability;
import io.natator.protocol.SimulationResult.Status;
import io.natator.verdict.Refusals;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Gaits that go far where they do not break a law of mechanics, and break one from some starts. */
class UnstableGaitsTest {

    private static final List<String> LAWS = List.of("tank", "energy", "tank", "shape", "particle-energy");

    /** Half of the gaits cheat: they go ten units further than others, and break a law from one of so many starts. */
    private static FakePool.Simulation cheating(int oneOf) {
        ToySimulator toy = new ToySimulator();
        return request -> {
            SimulationResult result = toy.evaluate(request);
            if (request.gait().hashCode() % 2 != 0) {
                return result;
            }
            int start = request.start() == null ? 0 : request.start();
            return Math.floorMod(start + request.gait().hashCode() / 2, oneOf) == 0
                    ? Results.unstable(request.id(), LAWS.get(Math.floorMod(start, LAWS.size())))
                    : result.withDistance(result.distance() + 10);
        };
    }

    private static ToyEvolution.Recorder run(EvolutionSettings settings, int oneOf) {
        ToyEvolution.Recorder recorder = new ToyEvolution.Recorder();
        ToyEvolution.run(settings, cheating(oneOf), recorder);
        return recorder;
    }

    private static Stream<Arguments> ways() {
        return Stream.of(OptimizerKind.values()).flatMap(optimizer -> Stream.of(Aggregate.values())
                .filter(judge -> judge == Aggregate.MEAN || optimizer != OptimizerKind.NSGA2)
                .flatMap(judge -> Stream.of(2, 3, 7).map(oneOf -> Arguments.of(optimizer, judge, oneOf))));
    }

    /** By whatever optimizer and judge: one broken run is enough. */
    @ParameterizedTest
    @MethodSource("ways")
    void noOtherRunsWinForAGaitThatWasUnstable(OptimizerKind optimizer, Aggregate judge, int oneOf) {
        EvolutionSettings settings = ToyEvolution.by(optimizer,
                EvolutionSettings.of("thesis/creature-3", EncodingKind.DENSE, 5)
                        .withSize(20, 4).withSeed(6).withStarts(4, judge));
        ToyEvolution.Recorder recorder = run(settings, oneOf);

        for (EvolutionState state : recorder.states) {
            Set<List<Double>> broken = recorder.evaluations.subList(0, (int) state.evaluations()).stream()
                    .filter(one -> one.result().status() == Status.UNSTABLE).map(EvaluationRecord::genes)
                    .collect(Collectors.toSet());
            assertThat(broken).isNotEmpty();
            List<Individual> chosen = new ArrayList<>(state.champions());
            if (state.best() != null) {
                chosen.add(state.best());
            }
            if (optimizer == OptimizerKind.NSGA2) {
                chosen.addAll(ParetoRanking.front(state.population(), settings.problem().genome().genes()));
            }
            if (optimizer == OptimizerKind.MAP_ELITES) {
                chosen.addAll(new EliteMap(state.population()).elites().values());
            }
            assertThat(chosen).isNotEmpty().allSatisfy(one -> assertThat(broken).doesNotContain(one.genes()));
            assertThat(state.population()).filteredOn(one -> broken.contains(one.genes())).allSatisfy(one -> {
                assertThat(one.fitness()).isZero();
                assertThat(one.score()).isNotPositive();
            });
        }
        Set<List<Double>> broken = recorder.evaluations.stream().filter(one -> one.result().status() == Status.UNSTABLE)
                .map(EvaluationRecord::genes).collect(Collectors.toSet());
        assertThat(GaitRanking.ranked(settings, recorder.evaluations)).isNotEmpty()
                .allSatisfy(one -> assertThat(broken).doesNotContain(one.genes()));
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 4})
    void aRunTellsWhichLawsItsEvaluationsBroke(int starts) throws JsonProcessingException {
        ToyEvolution.Recorder recorder = run(
                EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2).withSize(20, 3)
                        .withSeed(2).withStarts(starts, Aggregate.MEAN),
                starts);

        EvolutionState end = recorder.states.get(3);
        TreeMap<String, Integer> laws = new TreeMap<>();
        recorder.evaluations.stream().filter(one -> one.result().status() == Status.UNSTABLE)
                .forEach(one -> laws.merge(one.result().unstable().law(), 1, Integer::sum));
        assertThat(laws).isNotEmpty();
        int all = laws.values().stream().mapToInt(Integer::intValue).sum();
        assertThat(end.history().stream().mapToInt(GenerationSummary::unstable).sum()).isEqualTo(all);
        assertThat(Refusals.of(end)).startsWith("refused " + all + " of " + end.evaluations() + " evaluations: ")
                .doesNotContain("\n").contains(" broke law ");
        laws.forEach((law, count) -> assertThat(Refusals.of(end))
                .containsPattern("\\b" + count + "( broke law)? " + law + "\\b"));
        assertThat(Json.parse(Json.document(end), EvolutionState.class)).as("kept in a checkpoint").isEqualTo(end);
    }

    @Test
    void whatIsUnstableInVacuumHasNoNetDistance() throws InterruptedException {
        SimulationRequest request = SimulationRequest.of("thesis/creature-1", new Gait(1.5, List.of(0.6), List.of(0.3)))
                .withId(7);
        FakePool.Simulation simulator = one -> one.overrides() == null ? new ToySimulator().evaluate(one)
                : Results.unstable(one.id(), "shape");
        try (Evaluator pool = new FakePool(simulator, 1)) {
            SimulationResult result = FitnessEvaluator
                    .of(pool, EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
                            .withFitness(FitnessKind.NET, false).problem())
                    .evaluate(request);

            assertThat(result.status()).isEqualTo(Status.UNSTABLE);
            assertThat(result.id()).isEqualTo(7);
            assertThat(result.score()).isZero();
            assertThat(result.brokenLaw()).isEqualTo("shape");
            assertThat(result.error()).isEqualTo("in vacuum: unstable at 0.50 s (broke law shape)");
        }
    }

    /** Folders of programs that looked for finite numbers alone. */
    @Test
    void runsWithoutLawsAreReadAsBefore() throws JsonProcessingException {
        GenerationSummary old = Json
                .parse("{\"generation\":0,\"best\":1,\"mean\":0,\"median\":0,\"worst\":-1,\"population\":10,"
                        + "\"evaluations\":10,\"unstable\":2,\"failed\":0,\"unchanged\":0}", GenerationSummary.class);
        Estimate estimate = Json.parse("{\"score\":1,\"runs\":[1,1]}", Estimate.class);
        Instability instability = Json.parse("{\"particle\":3,\"stage\":\"springs\",\"time\":0.5}", Instability.class);

        assertThat(old.brokenLaws()).containsExactly(Map.entry("finite", 2));
        assertThat(estimate.isStable()).isTrue();
        assertThat(Json.document(estimate)).doesNotContain("table");
        assertThat(instability.law()).isNull();
        assertThat(Results.unstable(0, null).whyUnstable()).isEqualTo("unstable at 0.50 s");
        Individual one = new Individual(List.of(1.0), 0, Results.ok(1.0));
        assertThat(Refusals.of(new EvolutionState(0, 10, List.of(one), one, List.of(old))))
                .isEqualTo("refused 2 of 10 evaluations: 2 broke law finite");
        assertThat(Refusals.of(new EvolutionState(0, 10, List.of(one), one,
                List.of(new GenerationSummary(0, 1, 0, 0, -1, 10, 10, 0, 3))))).isNull();
        assertThat(new EliteMap(List.of(new Individual(List.of(1.0), 0, Results.unstable(1, "tank")),
                new Individual(List.of(2.0), 0, one.result().withEffort(new Effort(8, 1, 2, 12))))).elites())
                .hasSize(1);
    }
}
