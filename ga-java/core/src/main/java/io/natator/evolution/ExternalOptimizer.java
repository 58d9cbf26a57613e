package io.natator.evolution;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.InvalidInputException;
import io.natator.base.Numbers;
import io.natator.config.Budget;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.encoding.GeneRange;
import io.natator.process.OptimizerPipe;
import io.natator.protocol.SimulatorFailure;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * An optimizer outside this program, by the protocol of {@code ga-java/docs/external.md}. It is asked for all generations from the first,
 * also when a run continues: those that are recorded are told again as they are recorded, whatever it asks for. So one that repeats itself
 * goes on as without an interruption, and one that does not has all that was simulated.
 */
final class ExternalOptimizer implements Optimizer {

    static final int PROTOCOL = 1;
    private static final Logger LOG = LoggerFactory.getLogger(ExternalOptimizer.class);
    private static final Set<String> KEYS = Set.of("generation", "candidates");

    private final EvolutionSettings settings;
    private final List<GeneRange> ranges;
    private final OptimizerPipe pipe;
    private List<List<Individual>> earlier = List.of();
    private boolean begun;
    private int generation;

    /** By what kinds of gaits are told apart; see {@link EliteMap}. */
    record Measures(double beatsPerLength, double costOfTransport) {
    }

    ExternalOptimizer(EvolutionSettings settings, List<GeneRange> ranges, OptimizerPipe pipe) {
        this.settings = settings;
        this.ranges = ranges;
        this.pipe = pipe;
    }

    @Override
    public void recall(List<List<Individual>> newEarlier) {
        earlier = newEarlier;
    }

    @Override
    public List<List<Double>> propose(int number, List<Individual> before) {
        if (pipe == null) {
            throw new InvalidInputException(
                    "optimizer external has no pipe here; expected natator evolve, or resume, of one run");
        }
        if (!begun) {
            begun = true;
            begin();
        }
        return ask(number);
    }

    private void begin() {
        Map<String, Object> begin = message("begin");
        begin.put("protocol", PROTOCOL);
        begin.put("scene", settings.problem().scene());
        begin.put("genes", ranges);
        begin.put("population", settings.search().population());
        int generations = settings.budget().generations();
        begin.put("generations", generations == Budget.NO_LIMIT ? null : generations);
        begin.put("evaluations", settings.budget().evaluations());
        begin.put("starts", settings.search().starts());
        begin.put("seed", settings.search().seed());
        begin.put("recorded", earlier.size());
        pipe.send(begin);
        boolean repeats = true;
        for (List<Individual> recorded : earlier) {
            List<List<Double>> asked = ask(generation);
            List<List<Double>> genes = recorded.stream().map(Individual::genes).toList();
            if (repeats && !asked.subList(0, Math.min(asked.size(), genes.size())).equals(genes)) {
                repeats = false;
                LOG.warn(
                        "the optimizer asks otherwise than before in generation {}: the run goes on, but not as if it had "
                                + "never been interrupted",
                        generation);
            }
            tell(recorded);
            generation++;
        }
    }

    private List<List<Double>> ask(int number) {
        generation = number;
        Map<String, Object> ask = message("ask");
        ask.put("generation", number);
        pipe.send(ask);
        try {
            String line = pipe.receive();
            try {
                return candidates(Json.parse(line, ObjectNode.class));
            } catch (JsonProcessingException e) {
                throw wrong(Json.reasonInLine(e));
            }
        } catch (SimulatorFailure e) {
            throw new EvolutionFailedException("optimizer: " + e.getMessage() + " in generation " + number
                    + "; what was simulated before is kept, and natator resume goes on from there", e);
        } catch (InterruptedException e) {
            throw new EvolutionStoppedException("stopped before generation " + number);
        }
    }

    private List<List<Double>> candidates(ObjectNode answer) {
        answer.fieldNames().forEachRemaining(key -> {
            if (!KEYS.contains(key)) {
                throw wrong(key + ": unknown key; expected candidates, generation");
            }
        });
        JsonNode number = answer.path("generation");
        if (!number.isMissingNode() && !(number.isIntegralNumber() && number.asLong() == generation)) {
            throw wrong("generation is " + Json.shown(number) + "; expected " + generation + ", which was asked for");
        }
        JsonNode list = answer.path("candidates");
        int population = settings.search().population();
        if (!list.isArray() || list.isEmpty() || list.size() > population) {
            throw wrong("candidates are " + (list.isArray() ? String.valueOf(list.size())
                    : list.isMissingNode() ? "missing" : Json.shown(list)) + "; expected a list of 1 to " + population);
        }
        List<List<Double>> candidates = new ArrayList<>();
        for (JsonNode genes : list) {
            candidates.add(candidate(candidates.size() + 1, genes));
        }
        return candidates;
    }

    private List<Double> candidate(int number, JsonNode genes) {
        List<Double> values = new ArrayList<>();
        if (!genes.isArray()) {
            throw wrong("candidate " + number + " is " + Json.shown(genes) + "; expected a list of "
                    + Numbers.count(ranges.size(), "gene"));
        }
        for (JsonNode gene : genes) {
            if (!gene.isNumber()) {
                throw wrong("candidate " + number + ": gene " + (values.size() + 1) + " is " + Json.shown(gene)
                        + "; expected a number");
            }
            values.add(gene.asDouble());
        }
        try {
            GeneRange.check(ranges, values);
        } catch (IllegalArgumentException e) {
            throw wrong("candidate " + number + ": " + e.getMessage());
        }
        return List.copyOf(values);
    }

    /** What is wrong with the line that was received last, which the optimizer is told too. */
    private InvalidInputException wrong(String what) {
        String line = "optimizer, line " + pipe.received() + ": " + what;
        Map<String, Object> end = message("end");
        end.put("error", line);
        pipe.send(end);
        begun = false;
        return new InvalidInputException(line);
    }

    @Override
    public List<Individual> population(List<Individual> newborns) {
        tell(newborns);
        return newborns;
    }

    private void tell(List<Individual> newborns) {
        Map<String, Object> tell = message("tell");
        tell.put("generation", generation);
        tell.put("candidates", newborns.stream().map(ExternalOptimizer::told).toList());
        pipe.send(tell);
    }

    private static Map<String, Object> told(Individual one) {
        Map<String, Object> told = new LinkedHashMap<>();
        told.put("genes", one.genes());
        told.put("status", one.isStable() ? one.result().status() : "unstable");
        told.put("fitness", one.isMeasured() ? one.score() : null);
        if (one.estimate() != null) {
            told.put("runs", one.estimate().runs());
        }
        if (one.objectives() != null) {
            told.put("objectives", one.objectives());
        }
        if (one.isMeasured() && one.effort() != null && EliteMap.moves(one.effort())) {
            told.put("measures", new Measures(one.effort().beatsPerLength(), one.effort().costOfTransport()));
        }
        if (!one.isMeasured() && one.result().error() != null) {
            told.put("error", one.result().error());
        }
        return told;
    }

    private static Map<String, Object> message(String what) {
        Map<String, Object> message = new LinkedHashMap<>();
        message.put("do", what);
        return message;
    }

    @Override
    public void close() {
        if (begun) {
            pipe.send(message("end"));
        }
    }
}
