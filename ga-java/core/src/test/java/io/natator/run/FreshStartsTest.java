package io.natator.run;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.FreshRuns;
import io.natator.checkpoint.RunWriter;
import io.natator.checkpoint.SwimSample;
import io.natator.config.Aggregate;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.ToySimulator;
import io.natator.process.Evaluator;
import io.natator.process.FakePool;
import io.natator.process.FakeSimulator;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.Results;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Predicate;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** What is reported of a winner. */
class FreshStartsTest {

    @TempDir
    private Path folder;
    private final List<SimulationRequest> asked = new ArrayList<>();

    /** The toy swimmer, who takes down what it is asked. */
    private FakePool.Simulation recorder(Predicate<SimulationRequest> refused, RequestRejectedException refusal) {
        FakePool.Simulation toy = new ToySimulator();
        return request -> {
            if (refused.test(request)) {
                throw refusal;
            }
            synchronized (asked) {
                asked.add(request);
            }
            return toy.evaluate(request);
        };
    }

    private BestGait best(int starts, Aggregate judge, FakePool.Simulation simulator) throws InterruptedException {
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2).withSize(12, 3)
                .withStarts(starts, judge);
        ExecutionSettings how = FakeSimulator.execution(folder);
        try (RunWriter run = RunWriter.create(folder.resolve("run"), settings);
                Evaluator pool = new FakePool(simulator, 2)) {
            BestGait best = new EvolutionRun(run).run(how, pool).best();
            assertThat(Json.read(folder.resolve("run/best.json"), BestGait.class, "best")).isEqualTo(best);
            return best;
        }
    }

    @ParameterizedTest
    @CsvSource({"1, MEAN, 4", "3, MEDIAN, 6", "4, LOWER_QUARTILE, 8"})
    void aWinnerIsRunFromStartsThatNoGenerationHad(int starts, Aggregate judge, int fresh) throws InterruptedException {
        BestGait best = best(starts, judge, recorder(request -> false, null));

        List<EvaluationRecord> evolved = RunWriter.open(folder.resolve("run")).recorded().rows();
        List<Integer> used = evolved.stream().map(EvaluationRecord::start).toList();
        List<SimulationRequest> after = asked.stream()
                .filter(one -> one.start() != null && !used.contains(one.start())).toList();
        assertThat(after).hasSize(2 * fresh).allMatch(one -> one.gait().equals(best.gait()));
        List<Integer> base = after.stream().filter(one -> one.overrides() == null).map(SimulationRequest::start)
                .toList();
        List<Integer> half = after.stream().filter(one -> one.overrides() != null
                && one.overrides().at("/solver/substeps").asInt() == 8).map(SimulationRequest::start).toList();
        assertThat(base).hasSize(fresh).doesNotHaveDuplicates();
        assertThat(half).containsExactlyInAnyOrderElementsOf(base);

        FreshRuns runs = best.fresh();
        assertThat(runs.base().runs()).isEqualTo(fresh);
        assertThat(runs.base().substeps()).isEqualTo(4);
        assertThat(runs.halfStep().substeps()).isEqualTo(8);
        assertThat(runs.halfStep().distance()).isEqualTo(runs.base().distance());
        assertThat(runs.base().distance().sd()).isBetween(0.01, 0.3);
        assertThat(runs.selected()).isEqualTo(best.selected());
        assertThat(runs.selectionLoss()).isCloseTo(1 - runs.again() / best.selected(), within(1e-12));
        assertThat(runs.judge()).isEqualTo(judge);
        assertThat(best.runs()).isEqualTo(runs.selectedRuns()).isGreaterThanOrEqualTo(starts);
        // What is watched begins where whoever watches it begins.
        assertThat(asked).anyMatch(one -> one.start() == null && one.overrides() == null
                && one.gait().equals(best.gait()) && one.id() == best.result().id());
        double own = starts == 1 ? best.selected() : best.distance();
        assertThat(best.result().distance()).isEqualTo(own);
    }

    /** What the run found is not lost where the simulator does not know starts. */
    @Test
    void withoutFreshStartsThereIsStillAWinner() throws InterruptedException {
        BestGait best = best(1, Aggregate.MEAN,
                recorder(request -> request.start() != null, FakeSimulator.rejection("request: start: unknown")));

        assertThat(best.fresh()).isNull();
        assertThat(best.vacuum()).isNotNull();
    }

    /** Nothing is left out because the simulator is there no more: the run is to be continued when it is. */
    @ParameterizedTest
    @ValueSource(booleans = {true, false})
    void aSimulatorThatIsGoneEndsTheRun(boolean inVacuum) {
        FakePool.Simulation leaving = recorder(
                request -> inVacuum ? request.overrides() != null : request.start() != null,
                new RequestRejectedException("cannot start natator-sim", false));

        assertThatThrownBy(() -> best(1, Aggregate.MEAN, leaving)).isInstanceOf(RequestRejectedException.class)
                .hasMessage("cannot start natator-sim");
    }

    /** A gait that hits the wall after a quarter of the time is not four times as fast; what is unstable goes nowhere. */
    @Test
    void distancesAreThoseOfTheWholeTime() {
        List<SimulationResult> results = List.of(result("touched-plane", 0.6, 1.0, 0.5),
                result("completed", 0.4, 4.0, 1.5), Results.unstable(0, "tank"), SimulationResult.failed(0, "crashed"));

        SwimSample sample = SwimSample.of(results, 4,
                EncodingKind.DENSE.forActuators(2).decode(List.of(2.0, 0.5, 0.5, 0.5)), 4.0, 1.25);

        assertThat(sample.distance().mean()).isCloseTo(0.25, within(1e-12));
        assertThat(sample.distance().sd()).isCloseTo(0.3, within(1e-12));
        assertThat(sample.speed().mean()).isCloseTo(0.0625, within(1e-12));
        assertThat(sample.bodyLengths().mean()).isCloseTo(0.05, within(1e-12));
        assertThat(sample.perBeat().mean()).isCloseTo(0.025, within(1e-12));
        assertThat(sample.completed()).isEqualTo(0.25);
        assertThat(sample.stopped()).containsEntry("touched-plane", 1).containsEntry("unstable", 1)
                .containsEntry("failed", 1).containsEntry("completed", 1);
        assertThat(sample.work()).isEqualTo(1.0);
        assertThat(sample.costOfTransport()).isCloseTo(4.0, within(1e-12));
        assertThat(sample.reynolds()).isNull();
    }

    private static SimulationResult result(String stopped, double distance, double simulated, double work) {
        return Results.ok(distance).with(to -> to.stopped(stopped).simulated(simulated).work(work));
    }
}
