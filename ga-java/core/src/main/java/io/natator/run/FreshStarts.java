package io.natator.run;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.checkpoint.FreshRuns;
import io.natator.config.EvolutionSettings;
import io.natator.encoding.Gait;
import io.natator.evolution.Individual;
import io.natator.simulator.Evaluator;
import io.natator.simulator.RequestRejectedException;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Runs a winner from starts that no generation had, as the run simulates and at half the time step. */
final class FreshStarts {

    private static final Logger LOG = LoggerFactory.getLogger(FreshStarts.class);
    /** Runs at each time step: twice those that a newborn has, and enough for a standard deviation. */
    private static final int LEAST = 4;

    private final EvolutionSettings settings;
    private final Evaluator evaluator;
    private final WinnerRuns again;

    /**
     * For the winner of one run.
     *
     * @param evaluator as in the run: what it measures is judged as there
     * @param simulator the native program
     */
    FreshStarts(EvolutionSettings settings, Evaluator evaluator, Path simulator) throws InterruptedException {
        this.settings = settings;
        this.evaluator = evaluator;
        this.again = new WinnerRuns(settings, simulator);
    }

    /** The winner again, or null if the simulator refuses that. */
    FreshRuns of(Individual winner) throws InterruptedException {
        Gait gait = gait(winner);
        List<SimulationResult> base = runs(gait, null);
        if (base == null) {
            return null;
        }
        List<SimulationResult> half = runs(gait, again.halfStep());
        return FreshRuns.of(again.duration(), again.sample(base, gait, 1),
                half == null ? null : again.sample(half, gait, 2), settings.judge(), winner.score(),
                winner.runs(), settings.judge().of(base.stream().map(SimulationResult::score).toList()));
    }

    /** From the fresh starts; null, and a word of it, if the simulator refuses them. What the run found is not lost by that. */
    private List<SimulationResult> runs(Gait gait, ObjectNode change) throws InterruptedException {
        int starts = Math.max(LEAST, 2 * settings.starts());
        List<SimulationResult> results = new ArrayList<>();
        try {
            evaluator.evaluateInOrder(again.requests(gait, starts, change), results::add);
        } catch (RequestRejectedException e) {
            LOG.warn("the winner is not run from fresh starts: {}", e.getMessage());
            return null;
        }
        return results;
    }

    /** The winner from the scene's own start, as whoever watches it sees it. */
    SimulationResult fromOwnStart(Individual winner) throws InterruptedException {
        return evaluator.evaluate(new SimulationRequest(winner.result().id(), settings.scene(), gait(winner),
                settings.duration(), settings.scheme(), settings.overrides()));
    }

    private Gait gait(Individual winner) {
        return settings.encoding().forActuators(settings.actuators()).decode(winner.genes());
    }
}
