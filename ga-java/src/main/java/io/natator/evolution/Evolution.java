package io.natator.evolution;

import io.natator.analysis.GenerationSummary;
import io.natator.config.EvolutionSettings;
import io.natator.encoding.Encoding;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import io.natator.simulator.WorkerPool;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

/**
 * Evolves the gait of one creature. The course depends on the settings and the simulator's answers only: not on the
 * number of workers, nor on whether it was interrupted and continued.
 */
public final class Evolution {

    private final EvolutionSettings settings;
    private final Encoding encoding;
    private final WorkerPool pool;
    private final List<EvolutionListener> listeners;
    private final Map<Long, EvaluationRecord> replay;

    private int generation;
    private long evaluations;
    /** Results of the current generation's simulations, in the order of their ids. */
    private final List<SimulationResult> simulated = new ArrayList<>();

    /**
     * An evolution that has not begun.
     *
     * @param pool      carries out the simulations; stays open
     * @param listeners told of everything in this order
     * @param replay    simulations by id that an interrupted run had already finished after its last checkpoint; empty
     *                  for a new run
     */
    public Evolution(EvolutionSettings settings, WorkerPool pool, List<EvolutionListener> listeners,
            Map<Long, EvaluationRecord> replay) {
        this.settings = settings;
        this.encoding = settings.encoding().forActuators(settings.actuators());
        this.pool = pool;
        this.listeners = List.copyOf(listeners);
        this.replay = Map.copyOf(replay);
    }

    /**
     * Runs to the last generation.
     *
     * @param from where to continue, or null to begin with a random generation
     * @return the state after the last generation
     * @throws EvolutionFailedException if most simulations of a generation fail
     */
    public EvolutionState run(EvolutionState from) {
        evaluations = from == null ? 0 : from.evaluations();
        try (GeneticAlgorithm algorithm = new GeneticAlgorithm(settings, encoding.genes(), this::simulate)) {
            EvolutionState state = from == null ? finish(null, algorithm.first()) : from;
            while (state.generation() < settings.generations()) {
                generation = state.generation() + 1;
                state = finish(state, algorithm.next(state.population(), generation));
            }
            return state;
        }
    }

    /** The state after a generation, announced to the listeners. */
    private EvolutionState finish(EvolutionState before, List<Individual> population) {
        Individual best = before == null ? null : before.best();
        for (Individual individual : population) {
            SimulationResult result = individual.result();
            if (result.status() == SimulationResult.Status.OK
                    && (best == null || result.distance() > best.result().distance())) {
                best = individual;
            }
        }
        double[] distances = population.stream().mapToDouble(one -> one.result().distanceOrZero()).toArray();
        List<GenerationSummary> history = new ArrayList<>(before == null ? List.of() : before.history());
        history.add(GenerationSummary.of(generation, distances, simulated.size(),
                count(SimulationResult.Status.UNSTABLE), count(SimulationResult.Status.FAILED)));
        EvolutionState state = new EvolutionState(generation, evaluations, population, best, history);
        listeners.forEach(listener -> listener.generationFinished(state));
        return state;
    }

    /** Simulates the new genomes of the current generation, save those that the interrupted run had finished. */
    private List<SimulationResult> simulate(List<List<Double>> genomes) {
        simulated.clear();
        listeners.forEach(listener -> listener.generationStarted(generation, genomes.size()));
        while (simulated.size() < genomes.size() && replay.containsKey(evaluations)) {
            accept(replayed(genomes.get(simulated.size())));
        }
        List<SimulationRequest> requests = new ArrayList<>();
        for (List<Double> genes : genomes.subList(simulated.size(), genomes.size())) {
            requests.add(new SimulationRequest(evaluations + requests.size(), settings.scene(),
                    encoding.decode(genes), settings.duration(), settings.scheme(), settings.overrides()));
        }
        try {
            pool.evaluateAll(requests, result -> {
                List<Double> genes = genomes.get(simulated.size());
                accept(new EvaluationRecord(generation, genes, encoding.decode(genes), result));
            });
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new EvolutionFailedException("interrupted", e);
        }
        failIfMostFailed();
        return List.copyOf(simulated);
    }

    private EvaluationRecord replayed(List<Double> genes) {
        EvaluationRecord found = replay.get(evaluations);
        if (!found.genes().equals(genes)) {
            throw new EvolutionFailedException("recorded evaluation " + evaluations
                    + " is of other genes than this evolution's: the run folder was changed, or made by another version");
        }
        return found;
    }

    private void accept(EvaluationRecord evaluation) {
        simulated.add(evaluation.result());
        evaluations++;
        listeners.forEach(listener -> listener.evaluated(evaluation));
    }

    private int count(SimulationResult.Status status) {
        return (int) simulated.stream().filter(result -> result.status() == status).count();
    }

    private void failIfMostFailed() {
        int failed = count(SimulationResult.Status.FAILED);
        if (2 * failed > simulated.size()) {
            String reason = simulated.stream().filter(result -> result.status() == SimulationResult.Status.FAILED)
                    .findFirst().map(SimulationResult::error).orElse("");
            throw new EvolutionFailedException("generation " + generation + ": " + failed + " of " + simulated.size()
                    + " simulations failed, the first: " + reason);
        }
    }
}
