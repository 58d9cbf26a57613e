package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.encoding.Encoding;
import io.natator.simulator.Evaluator;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import java.util.ArrayList;
import java.util.List;

/**
 * Evolves the gait of one creature. The course depends on the settings and the simulator's answers only: not on the
 * number of workers, nor on whether it was interrupted and continued.
 */
public final class Evolution {

    private final EvolutionSettings settings;
    private final Encoding encoding;
    private final Evaluator evaluator;
    private final List<EvolutionListener> listeners;
    private final List<EvaluationRecord> recorded;

    private int generation;
    private long evaluations;
    /** Results of the current generation's simulations, in the order of their ids. */
    private final List<SimulationResult> simulated = new ArrayList<>();

    /**
     * An evolution that has not begun.
     *
     * @param evaluator carries out the simulations; stays open
     * @param listeners told of everything in this order
     * @param recorded  simulations that an interrupted run had finished, in the order of their ids from 0; empty for a
     *                  new run
     */
    public Evolution(EvolutionSettings settings, Evaluator evaluator, List<EvolutionListener> listeners,
            List<EvaluationRecord> recorded) {
        this.settings = settings;
        this.encoding = settings.encoding().forActuators(settings.actuators());
        this.evaluator = evaluator;
        this.listeners = List.copyOf(listeners);
        this.recorded = List.copyOf(recorded);
    }

    /**
     * Runs to the last generation, or until the settings' number of evaluations is reached.
     *
     * @param from where to continue, or null to begin with a random generation
     * @return the state after the last generation
     * @throws EvolutionFailedException  if most simulations of a generation fail
     * @throws EvolutionStoppedException if the evaluator is closed or the calling thread interrupted
     */
    public EvolutionState run(EvolutionState from) {
        evaluations = from == null ? 0 : from.evaluations();
        if (recorded.size() < evaluations) {
            throw new IllegalArgumentException(recorded.size() + " simulations recorded; expected the " + evaluations
                    + " up to where the evolution is to continue");
        }
        try (Optimizer optimizer = Optimizer.of(settings, encoding.genes(), this::simulate)) {
            optimizer.recall(recorded.subList(0, (int) evaluations));
            EvolutionState state = from;
            while (state == null || !state.isLastOf(settings)) {
                generation = state == null ? 0 : state.generation() + 1;
                state = finish(state, optimizer.next(generation, state == null ? List.of() : state.population()));
            }
            return state;
        }
    }

    private long budgetLeft() {
        return settings.evaluations() == null ? Long.MAX_VALUE : Math.max(settings.evaluations() - evaluations, 0);
    }

    /** The state after a generation, announced to the listeners. */
    private EvolutionState finish(EvolutionState before, List<Individual> population) {
        Individual best = before == null ? null : before.best();
        for (Individual individual : population) {
            SimulationResult result = individual.result();
            if (result.status() == SimulationResult.Status.OK
                    && (best == null || result.score() > best.result().score())) {
                best = individual;
            }
        }
        double[] scores = population.stream().mapToDouble(one -> one.result().score()).toArray();
        List<GenerationSummary> history = new ArrayList<>(before == null ? List.of() : before.history());
        history.add(GenerationSummary.of(generation, scores, simulated.size(),
                count(SimulationResult.Status.UNSTABLE), count(SimulationResult.Status.FAILED)));
        EvolutionState state = new EvolutionState(generation, evaluations, population, best, history);
        listeners.forEach(listener -> listener.generationFinished(state));
        return state;
    }

    /** Simulates the new genomes of the current generation, save those that the interrupted run had finished. */
    private List<SimulationResult> simulate(List<List<Double>> proposed) {
        simulated.clear();
        List<List<Double>> genomes = proposed.subList(0, (int) Math.min(proposed.size(), budgetLeft()));
        listeners.forEach(listener -> listener.generationStarted(generation, genomes.size()));
        while (simulated.size() < genomes.size() && evaluations < recorded.size()) {
            accept(replayed(genomes.get(simulated.size())));
        }
        List<SimulationRequest> requests = new ArrayList<>();
        for (List<Double> genes : genomes.subList(simulated.size(), genomes.size())) {
            requests.add(new SimulationRequest(evaluations + requests.size(), settings.scene(),
                    encoding.decode(genes), settings.duration(), settings.scheme(), settings.overrides()));
        }
        try {
            evaluator.evaluateInOrder(requests, result -> {
                List<Double> genes = genomes.get(simulated.size());
                accept(new EvaluationRecord(generation, genes, encoding.decode(genes), result));
            });
        } catch (InterruptedException e) {
            throw new EvolutionStoppedException("stopped in generation " + generation + " after " + evaluations
                    + " evaluations");
        }
        failIfMostFailed();
        return List.copyOf(simulated);
    }

    private EvaluationRecord replayed(List<Double> genes) {
        EvaluationRecord found = recorded.get((int) evaluations);
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
