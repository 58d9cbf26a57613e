package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.config.Aggregate;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.config.OptimizerKind;
import io.natator.process.FakePool;
import io.natator.process.OptimizerPipe;
import io.natator.protocol.Results;
import io.natator.protocol.SimulationResult;
import java.io.IOException;
import java.io.InputStream;
import java.io.PipedInputStream;
import java.io.PipedOutputStream;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** What OptimizerTest does not look at: the messages, and what goes wrong with the other program. */
@Timeout(value = 5, unit = TimeUnit.MINUTES)
class ExternalOptimizerTest {

    private static final EvolutionSettings SETTINGS = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
            .withSize(4, 5).withSeed(6).withObjectives(OptimizerKind.EXTERNAL, null);

    private static EvolutionState run(EvolutionSettings settings, FakePool.Simulation simulator, ToyOptimizer optimizer,
            EvolutionState from, List<EvaluationRecord> recorded, EvolutionListener... listeners) {
        try (optimizer) {
            return ToyEvolution.run(settings, simulator, optimizer, 2, from, recorded, listeners);
        }
    }

    /** One that says something else instead when it is asked for this generation. */
    private static ToyOptimizer saying(String something, int generation) {
        return new ToyOptimizer() {
            @Override
            String answer(JsonNode message) throws IOException {
                String usual = super.answer(message);
                return message.get("do").asText().equals("ask") && message.get("generation").asInt() == generation
                        ? something : usual;
            }
        };
    }

    @Test
    void itIsToldWhatItAskedFor() {
        FakePool.Simulation simulator = request -> request.id() % 4 == 1 ? Results.unstable(request.id(), "tank")
                : request.id() % 4 == 2 ? SimulationResult.failed(request.id(), "gone")
                        : Results.ok(request.id(), 2.0).with(to -> to.work(3.0));
        ToyOptimizer optimizer = new ToyOptimizer();
        ToyEvolution.Recorder recorder = new ToyEvolution.Recorder();

        run(SETTINGS.withSize(4, 1), simulator, optimizer, null, List.of(), recorder);

        assertThat(optimizer.told.get(0)).isEqualTo("{\"do\":\"begin\",\"protocol\":1,\"scene\":\"thesis/creature-1\","
                + "\"genes\":[{\"name\":\"frequency\",\"lower\":0.5,\"upper\":2.0},"
                + "{\"name\":\"amplitude 1\",\"lower\":0.0,\"upper\":1.0},{\"name\":\"amplitude 2\",\"lower\":0.0,\"upper\":1.0},"
                + "{\"name\":\"phase 2\",\"lower\":0.0,\"upper\":1.0}],"
                + "\"population\":4,\"generations\":1,\"evaluations\":null,\"starts\":1,\"seed\":6,\"recorded\":0}");
        assertThat(optimizer.told.get(1)).isEqualTo("{\"do\":\"ask\",\"generation\":0}");
        EvaluationRecord first = recorder.evaluations.get(0);
        assertThat(optimizer.told.get(2)).startsWith("{\"do\":\"tell\",\"generation\":0,\"candidates\":[{\"genes\":"
                + Json.line(first.genes()) + ",\"status\":\"ok\",\"fitness\":2.0,\"measures\":{\"beatsPerLength\":"
                + 4 * first.gait().frequency() / (2.0 / ToyEvolution.BODY_LENGTH) + ",\"costOfTransport\":1.5}},{")
                .contains("\"status\":\"unstable\",\"fitness\":null}")
                .contains("\"status\":\"failed\",\"fitness\":null,\"error\":\"gone\"}");
        assertThat(optimizer.told.subList(3, 6)).satisfiesExactly(
                ask -> assertThat(ask).isEqualTo("{\"do\":\"ask\",\"generation\":1}"),
                tell -> assertThat(tell).startsWith("{\"do\":\"tell\",\"generation\":1,"),
                end -> assertThat(end).isEqualTo("{\"do\":\"end\"}"));
    }

    /** As scheme flex: there are no measures, which are no reason to refuse. */
    @Test
    void whatIsNotMeasuredIsNotTold() {
        FakePool.Simulation flex = request -> Results.ok(request.id(), 1.0).withScheme("flex");
        ToyOptimizer optimizer = new ToyOptimizer();

        run(SETTINGS.withSize(4, 0).withStarts(2, Aggregate.MEAN), flex, optimizer, null, List.of());

        assertThat(optimizer.told.get(2)).contains("\"status\":\"ok\",\"fitness\":1.0,\"runs\":[1.0,1.0]}");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "[[1,0,0,0]]                                          | expected an object",
            "{                                                    | ends too early; expected the rest of the JSON text",
            "{}                                                   | candidates are missing; expected a list of 1 to 4",
            "{\"candidates\":[]}                                  | candidates are 0; expected a list of 1 to 4",
            "{\"candidates\":[[1],[1],[1],[1],[1]]}               | candidates are 5; expected a list of 1 to 4",
            "{\"candidates\":[[1,0,0,0],[1,0,0]]}                 | candidate 2: 3 genes given; expected 4: frequency, amplitude 1",
            "{\"candidates\":[[1,0,0,0],[1,0,1.5,0]]}             | candidate 2: gene 3 (amplitude 2) is 1.5; expected a number from 0.0 to 1.0",
            "{\"candidates\":[[1,0,0,0],[1,0,null,0]]}            | candidate 2: gene 3 is null; expected a number",
            "{\"candidates\":[[1,0,0,0],7]}                       | candidate 2 is 7; expected a list of 4 genes",
            "{\"candidates\":[[1,0,0,NaN]]}                       | Non-standard token 'NaN'",
            "{\"candidates\":[[1,0,0,1e999]]}                     | found the number 1e999; expected one within 1.8e308",
            "{\"candidates\":[[1,0,0,0]],\"generation\":3}        | generation is 3; expected 2, which was asked for",
            "{\"candidates\":[[1,0,0,0]],\"ids\":[3]}             | ids: unknown key; expected candidates, generation"})
    void whatCannotBeUsedIsOneLineThatNamesIt(String said, String wrong) {
        ToyOptimizer optimizer = saying(said + "\n", 2);
        ToyEvolution.Recorder recorder = new ToyEvolution.Recorder();

        assertThatThrownBy(() -> run(SETTINGS, new ToySimulator(), optimizer, null, List.of(), recorder))
                .isInstanceOf(InvalidInputException.class).hasMessageStartingWith("optimizer, line 3: ")
                .hasMessageContaining(wrong).hasMessageNotContaining("\n");
        assertThat(recorder.evaluations).hasSize(8);
    }

    /** Whether it closes its end or ends in the middle of a line, the run goes on with another that is like it. */
    @ParameterizedTest
    @ValueSource(strings = {"", "{\"candidates\":[[1,0"})
    void itsDeathLosesNothing(String last) {
        ToyEvolution.Recorder whole = new ToyEvolution.Recorder();
        EvolutionState end = run(SETTINGS, new ToySimulator(), new ToyOptimizer(), null, List.of(), whole);
        ToyEvolution.Recorder recorder = new ToyEvolution.Recorder();
        ToyOptimizer dying = new ToyOptimizer() {
            @Override
            String answer(JsonNode message) throws IOException {
                String usual = super.answer(message);
                if (message.path("generation").asInt() == 3) {
                    say(last);
                    throw new IOException("the end");
                }
                return usual;
            }
        };

        assertThatThrownBy(() -> run(SETTINGS, new ToySimulator(), dying, null, List.of(), recorder))
                .isInstanceOf(EvolutionFailedException.class)
                .hasMessage("optimizer: output ended" + (last.isEmpty() ? "" : " within a line: \"" + last + "\"")
                        + " in generation 3; what was simulated before is kept, and natator resume goes on from there");

        assertThat(recorder.states).hasSize(3);
        ToyOptimizer next = new ToyOptimizer();
        assertThat(run(SETTINGS, new ToySimulator(), next, recorder.states.get(2), recorder.evaluations, recorder))
                .isEqualTo(end);
        assertThat(recorder.evaluations).isEqualTo(whole.evaluations);
        assertThat(next.told.get(0)).contains("\"recorded\":3");
    }

    /** One that does not repeat itself is told what was simulated, also of the generation that was under way, and goes on from there. */
    @Test
    void whatIsRecordedStaysAlsoIfItAsksOtherwise() {
        ToyEvolution.Recorder recorder = new ToyEvolution.Recorder();
        run(SETTINGS.withStarts(2, Aggregate.MEAN), new ToySimulator(), new ToyOptimizer(), null, List.of(), recorder);
        EvolutionState state = recorder.states.get(1);
        List<EvaluationRecord> kept = recorder.evaluations.subList(0, (int) state.evaluations() + 3);
        List<EvaluationRecord> all = new ArrayList<>();
        ToyOptimizer other = new ToyOptimizer() {
            @Override
            List<List<Double>> candidates() {
                super.candidates();
                return super.candidates();
            }
        };

        for (EvolutionState from : new EvolutionState[] {state, null}) {
            all.clear();
            EvolutionState end = run(SETTINGS.withStarts(2, Aggregate.MEAN), new ToySimulator(),
                    from == null ? new ToyOptimizer() : other, from, kept, new EvolutionListener() {
                        @Override
                        public void evaluated(EvaluationRecord evaluation) {
                            all.add(evaluation);
                        }
                    });
            assertThat(end.generation()).isEqualTo(5);
            assertThat(all.subList(0, from == null ? kept.size() : 3))
                    .isEqualTo(from == null ? kept : kept.subList((int) state.evaluations(), kept.size()));
        }

        List<EvaluationRecord> half = kept.subList((int) state.evaluations(), kept.size());
        String told = other.told.stream().filter(line -> line.startsWith("{\"do\":\"tell\",\"generation\":2,"))
                .findFirst()
                .orElseThrow();
        assertThat(told).contains(Json.line(half.get(0).genes()), Json.line(half.get(2).genes()));
        assertThat(other.told.stream().filter(line -> line.startsWith("{\"do\":\"tell\",\"generation\":0,")))
                .singleElement()
                .asString().contains(Json.line(recorder.evaluations.get(0).genes()));
    }

    @Test
    void aWaitEndsWithThePipe() {
        ToyOptimizer waiting = new ToyOptimizer() {
            @Override
            String answer(JsonNode message) {
                pipe.close();
                return null;
            }
        };

        assertThatThrownBy(() -> run(SETTINGS, new ToySimulator(), waiting, null, List.of()))
                .isInstanceOf(EvolutionStoppedException.class).hasMessage("stopped before generation 0");
    }

    /** Nor does this program wait for what it says to be read. */
    @Test
    @Timeout(value = 1, unit = TimeUnit.MINUTES)
    void nobodyIsBlockedByOneThatDoesNotRead() throws IOException {
        OptimizerPipe pipe = new OptimizerPipe(InputStream.nullInputStream(),
                new PipedOutputStream(new PipedInputStream(1)));

        pipe.send("more than a pipe of one byte takes");
        pipe.close();

        assertThatThrownBy(pipe::receive).isInstanceOf(InterruptedException.class);
    }

    @Test
    void withoutAPipeThereIsNone() {
        assertThatThrownBy(() -> run(SETTINGS, new ToySimulator(), null, null, List.of()))
                .isInstanceOf(InvalidInputException.class)
                .hasMessageStartingWith("optimizer external has no pipe here");
    }
}
