package io.natator.run;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.body.Genome;
import io.natator.body.Swimmer;
import io.natator.checkpoint.FreshRuns;
import io.natator.config.EvolutionSettings;
import io.natator.evolution.Individual;
import io.natator.fitness.FitnessEvaluator;
import io.natator.process.Evaluator;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.IntStream;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Runs gaits from starts that no generation had, as the run simulates; its winner at half the time step too. */
public final class FreshStarts {

    private static final Logger LOG = LoggerFactory.getLogger(FreshStarts.class);
    /** Runs at each time step: twice those that a newborn has, and enough for a standard deviation. */
    private static final int MIN_STARTS = 4;

    private final EvolutionSettings settings;
    private final Evaluator evaluator;
    private final WinnerRuns again;
    private final Genome genome;

    /**
     * For the gaits of one run.
     *
     * @param evaluator carries out the evaluations; what it measures is judged as in the run
     * @param simulator the native program
     */
    public FreshStarts(EvolutionSettings settings, Evaluator evaluator, Path simulator) throws InterruptedException {
        this.settings = settings;
        this.evaluator = FitnessEvaluator.of(evaluator, settings.problem());
        this.again = new WinnerRuns(settings, simulator);
        this.genome = settings.problem().genome();
    }

    /** From how many starts a run's winner is run again. */
    public static int usual(EvolutionSettings settings) {
        return Math.max(MIN_STARTS, 2 * settings.search().starts());
    }

    /**
     * Gaits of the run again, all from the same starts: the more there are, the first are the same.
     *
     * @param genomes what stands for the gaits
     * @param starts  of each
     * @return what came of each, in this order
     * @throws RequestRejectedException if the simulator refuses that
     */
    public List<List<SimulationResult>> each(List<List<Double>> genomes, int starts) throws InterruptedException {
        List<SimulationRequest> requests = new ArrayList<>();
        for (List<Double> genes : genomes) {
            for (SimulationRequest one : again.requests(genome.decode(genes), starts, null)) {
                requests.add(one.withId(requests.size()));
            }
        }
        List<SimulationResult> results = evaluator.evaluate(requests);
        return IntStream.range(0, genomes.size()).mapToObj(i -> results.subList(i * starts, (i + 1) * starts)).toList();
    }

    /** The winner again, or null if the simulator refuses that. */
    FreshRuns of(Individual winner) throws InterruptedException {
        Swimmer swimmer = genome.decode(winner.genes());
        List<SimulationResult> base = runs(swimmer, null);
        if (base == null) {
            return null;
        }
        List<SimulationResult> half = runs(swimmer, again.halfStep());
        return FreshRuns.of(again.duration(), again.sample(base, swimmer, 1),
                half == null ? null : again.sample(half, swimmer, 2), settings.search().judge(), winner.score(),
                winner.runs(), base.stream().map(SimulationResult::score).toList());
    }

    /** From the fresh starts; null, and a word of it, if the simulator refuses them. What the run found is not lost by that. */
    private List<SimulationResult> runs(Swimmer swimmer, ObjectNode change) throws InterruptedException {
        try {
            return evaluator.evaluate(again.requests(swimmer, usual(settings), change));
        } catch (RequestRejectedException e) {
            e.throwUnlessBadInput();
            LOG.warn("the winner is not run from fresh starts: {}", e.getMessage());
            return null;
        }
    }

    /** Runs the winner from the scene's own start, as it is watched. */
    SimulationResult fromOwnStart(Individual winner) throws InterruptedException {
        return evaluator.evaluate(SimulationRequest.of(winner.result().id(), settings, genome.decode(winner.genes())));
    }
}
