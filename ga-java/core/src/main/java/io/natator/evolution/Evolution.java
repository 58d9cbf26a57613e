package io.natator.evolution;

import io.natator.base.InvalidInputException;
import io.natator.base.Numbers;
import io.natator.body.Genome;
import io.natator.config.EvolutionSettings;
import io.natator.process.Evaluator;
import io.natator.process.OptimizerPipe;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/**
 * Evolves the gait or the body of one creature, or both. The course depends on the settings and the simulator's answers only: not on the
 * number of workers, nor on whether it was interrupted and continued.
 */
public final class Evolution {

    private final EvolutionSettings settings;
    private final Genome genome;
    private final Evaluator evaluator;
    private final List<EvolutionListener> listeners;
    private final RecordedEvaluations recorded;
    private final OptimizerPipe pipe;

    private int generation;
    private long evaluations;
    /** Results of the current generation's simulations, in the order of their ids. */
    private final List<SimulationResult> simulated = new ArrayList<>();
    /** Genes that are new in the current generation. */
    private final Set<List<Double>> born = new HashSet<>();

    /** A simulation to be made: of these genes, from this start. */
    private record Run(List<Double> genes, Integer start) {
    }

    /**
     * An evolution that has not begun.
     *
     * @param evaluator carries out the simulations; stays open
     * @param listeners told of everything in this order
     * @param recorded  simulations that an interrupted run had finished (a compacted run lacks the oldest); none for a new run
     * @param pipe      to an optimizer outside this program, which stays open; null without one
     */
    public Evolution(EvolutionSettings settings, Evaluator evaluator, List<EvolutionListener> listeners,
            RecordedEvaluations recorded, OptimizerPipe pipe) {
        this.settings = settings;
        this.genome = settings.problem().genome();
        this.evaluator = evaluator;
        this.listeners = List.copyOf(listeners);
        this.recorded = recorded;
        this.pipe = pipe;
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
        if (recorded.end() < evaluations) {
            throw new IllegalArgumentException(
                    Numbers.count(recorded.end(), "simulation") + " recorded; expected the " + evaluations
                            + " up to where the evolution is to continue");
        }
        try (Optimizer optimizer = Optimizer.of(settings, genome.genes(), pipe)) {
            optimizer.recall(earlier());
            EvolutionState state = from;
            while (state == null || !state.isLastOf(settings)) {
                List<Individual> parents = state == null ? List.of() : state.population();
                generation = state == null ? 0 : state.generation() + 1;
                simulated.clear();
                born.clear();
                List<List<Double>> newborn = announce(asRecorded(optimizer.propose(generation, parents)));
                state = finish(state, optimizer.population(newborns(newborn, simulate(runs(newborn)))));
            }
            return state;
        }
    }

    private long budgetLeft() {
        return settings.budget().evaluations() == null ? Long.MAX_VALUE
                : Math.max(settings.budget().evaluations() - evaluations, 0);
    }

    /** The state after a generation, announced to the listeners. */
    private EvolutionState finish(EvolutionState before, List<Individual> bred) {
        List<Individual> population = bred;
        List<Individual> champions = null;
        List<List<Double>> refused = null;
        Individual best = before == null ? null : before.best();
        if (settings.search().starts() > 1) {
            Reevaluation again = new Reevaluation(settings, this::repeat, bred,
                    before == null ? List.of() : before.champions(),
                    before == null || before.refused() == null ? List.of() : before.refused());
            champions = again.run();
            if (budgetLeft() > 0 && budgetLeft() < settings.search().starts()) {
                champions = again.useUp((int) budgetLeft());
            }
            population = bred.stream().map(again::known).toList();
            best = again.winner();
            refused = again.refused();
        } else {
            for (Individual individual : bred) {
                if (individual.isMeasured() && (best == null || individual.score() > best.score())) {
                    best = individual;
                }
            }
        }
        List<GenerationSummary> history = new ArrayList<>(before == null ? List.of() : before.history());
        history.add(GenerationSummary.of(generation, population, simulated.size(),
                count(SimulationResult.Status.UNSTABLE), count(SimulationResult.Status.FAILED))
                .withUnchanged(unchanged(population)).withLaws(broken()));
        EvolutionState state = new EvolutionState(generation, evaluations, population, best, history, champions,
                refused);
        listeners.forEach(listener -> listener.generationFinished(state));
        return state;
    }

    /** How many of a population were not simulated for it: those from before, and twins of newborns. */
    private int unchanged(List<Individual> population) {
        Set<List<Double>> found = population.stream().map(Individual::genes).collect(Collectors.toSet());
        found.retainAll(born);
        return population.size() - found.size();
    }

    /** What of a proposal can still be simulated, announced to the listeners. */
    private List<List<Double>> announce(List<List<Double>> proposed) {
        int starts = settings.search().starts();
        List<List<Double>> genomes = proposed.subList(0, (int) Math.min(proposed.size(), budgetLeft() / starts));
        born.addAll(genomes);
        int planned = (int) Math.min((long) genomes.size() * starts + settings.search().repeats(), budgetLeft());
        listeners.forEach(listener -> listener.generationStarted(generation, planned));
        return genomes;
    }

    /** Runs of new genomes: each from all starts of the generation. */
    private List<Run> runs(List<List<Double>> genomes) {
        int starts = settings.search().starts();
        List<Run> runs = new ArrayList<>();
        for (List<Double> genes : genomes) {
            for (int k = 0; k < starts; k++) {
                runs.add(new Run(genes, start(k)));
            }
        }
        return runs;
    }

    /** Individuals of several runs each, which stand one after another. */
    private List<Individual> newborns(List<List<Double>> genomes, List<SimulationResult> results) {
        int starts = settings.search().starts();
        List<Individual> newborns = new ArrayList<>();
        for (int i = 0; i < genomes.size(); i++) {
            List<SimulationResult> own = results.subList(i * starts, (i + 1) * starts);
            SimulationResult shown = own.stream().filter(one -> one.status() == SimulationResult.Status.OK).findFirst()
                    .orElse(own.get(0));
            newborns.add(new Individual(genomes.get(i), 0, shown,
                    starts == 1 ? null : Estimate.of(own, settings.search().judge())));
        }
        return newborns;
    }

    /** The newborns of each generation up to where the evolution continues. */
    private List<List<Individual>> earlier() {
        SortedMap<Integer, List<EvaluationRecord>> generations = new TreeMap<>();
        recorded.between(0, evaluations).forEach(
                one -> generations.computeIfAbsent(one.generation(), number -> new ArrayList<>()).add(one));
        return generations.values().stream().map(this::newborns).toList();
    }

    /**
     * What is to be simulated of a proposal. An optimizer outside this program may propose something else than before an interruption; then
     * what was begun before it comes first.
     */
    private List<List<Double>> asRecorded(List<List<Double>> proposed) {
        if (!settings.search().optimizer().isOutside()) {
            return proposed;
        }
        long end = recorded.end();
        List<List<Double>> genomes = new ArrayList<>(recorded.between(Math.min(evaluations, end), end).stream()
                .filter(one -> one.generation() == generation && Objects.equals(one.start(), start(0)))
                .map(EvaluationRecord::genes).toList());
        genomes.addAll(proposed.subList(Math.min(genomes.size(), proposed.size()), proposed.size()));
        return genomes;
    }

    /** A start of the generation; null where gaits run from the scene's own. */
    private Integer start(int number) {
        return settings.search().starts() == 1 ? null : Seeds.start(settings.search().seed(), generation, number);
    }

    /** The newborns of a generation that these simulations are of. */
    private List<Individual> newborns(List<EvaluationRecord> earlier) {
        int starts = settings.search().starts();
        List<List<Double>> genomes = new ArrayList<>();
        List<SimulationResult> results = new ArrayList<>();
        for (EvaluationRecord one : earlier) {
            if (starts > 1 && one.start() != null && IntStream.range(0, starts)
                    .noneMatch(k -> one.start() == Seeds.start(settings.search().seed(), one.generation(), k))) {
                continue;
            }
            if (results.size() % starts == 0) {
                genomes.add(one.genes());
            }
            results.add(one.result());
        }
        return newborns(genomes, results);
    }

    private List<Individual> repeat(List<Individual> individuals, int first, int starts) {
        List<Run> runs = new ArrayList<>();
        for (Individual one : individuals) {
            for (int k = first; k < first + starts; k++) {
                runs.add(new Run(one.genes(), Seeds.start(settings.search().seed(), generation, k)));
            }
        }
        List<SimulationResult> results = simulate(runs.subList(0, (int) Math.min(runs.size(), budgetLeft())));
        List<Individual> repeated = new ArrayList<>();
        for (int i = 0; i * starts < results.size(); i++) {
            List<SimulationResult> own = results.subList(i * starts, Math.min((i + 1) * starts, results.size()));
            Individual one = individuals.get(i);
            repeated.add(one.withEstimate(one.estimate().with(own, settings.search().judge())));
        }
        return repeated;
    }

    /** Simulates, save what the interrupted run had finished. */
    private List<SimulationResult> simulate(List<Run> runs) {
        int before = simulated.size();
        while (simulated.size() - before < runs.size() && evaluations < recorded.end()) {
            accept(replayed(runs.get(simulated.size() - before)));
        }
        long first = evaluations;
        List<SimulationRequest> requests = new ArrayList<>();
        for (Run run : runs.subList(simulated.size() - before, runs.size())) {
            requests.add(SimulationRequest.of(evaluations + requests.size(), settings, genome.decode(run.genes()))
                    .withStart(run.start()));
        }
        try {
            evaluator.evaluateAll(requests, Evaluator.inOrder(requests, result -> {
                Run run = runs.get(simulated.size() - before);
                accept(new EvaluationRecord(generation, run.genes(), requests.get((int) (result.id() - first)).gait(),
                        result, run.start()));
            }));
        } catch (InterruptedException e) {
            throw new EvolutionStoppedException("stopped in generation " + generation + " after "
                    + Numbers.count(evaluations, "evaluation"));
        }
        failIfMostFailed();
        return List.copyOf(simulated.subList(before, simulated.size()));
    }

    private EvaluationRecord replayed(Run run) {
        EvaluationRecord found = recorded.get(evaluations);
        if (!found.genes().equals(run.genes()) || !Objects.equals(found.start(), run.start())) {
            throw new InvalidInputException("recorded evaluation " + evaluations
                    + " is of other genes, or from another start, than this evolution's: the run folder was changed, or made by another version");
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

    /** How many broke which law. */
    private SortedMap<String, Integer> broken() {
        SortedMap<String, Integer> laws = new TreeMap<>();
        simulated.stream().map(SimulationResult::brokenLaw).filter(Objects::nonNull)
                .forEach(law -> laws.merge(law, 1, Integer::sum));
        return laws;
    }

    private void failIfMostFailed() {
        int failed = count(SimulationResult.Status.FAILED);
        if (EvolutionFailedException.isDue(failed, simulated.size())) {
            String reason = simulated.stream().filter(result -> result.status() == SimulationResult.Status.FAILED)
                    .findFirst().map(SimulationResult::error).orElse("");
            throw new EvolutionFailedException("generation " + generation + ": " + failed + " of "
                    + Numbers.count(simulated.size(), "simulation") + " failed, the first: " + reason);
        }
    }
}
