package io.natator.run;

import io.natator.base.InvalidInputException;
import io.natator.cache.CachedEvaluator;
import io.natator.cache.EvaluationCache;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.Environment;
import io.natator.checkpoint.RunReader;
import io.natator.checkpoint.RunWriter;
import io.natator.checkpoint.SceneDigest;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.evolution.Evolution;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.Individual;
import io.natator.fitness.BodyCheckEvaluator;
import io.natator.fitness.FitnessEvaluator;
import io.natator.process.Evaluator;
import io.natator.process.OptimizerPipe;
import io.natator.process.SceneInfo;
import io.natator.process.TimeLimit;
import io.natator.protocol.SimulationResult;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;

/** Carries out the evolution of a run folder from wherever it stands to its end. */
public final class EvolutionRun {

    private final RunWriter folder;
    private final EvolutionSettings settings;
    private final OptimizerPipe pipe;

    /**
     * What came of a run.
     *
     * @param state after the last generation
     * @param best  the best gait with what it does in vacuum, or null if there is none
     */
    public record Outcome(EvolutionState state, BestGait best) {
    }

    /** A run whose folder stays open. */
    public EvolutionRun(RunWriter folder) {
        this(folder, null);
    }

    /**
     * A run by an optimizer outside this program, whose folder stays open.
     *
     * @param pipe to it, which stays open; null without one
     */
    public EvolutionRun(RunWriter folder, OptimizerPipe pipe) {
        this.folder = folder;
        this.pipe = pipe;
        this.settings = folder.settings();
    }

    /**
     * The execution with a time limit that suits the scene, if it has none.
     *
     * @throws io.natator.base.InvalidInputException if the simulator does not know the scene
     */
    public static ExecutionSettings withTimeLimit(ExecutionSettings execution, EvolutionSettings settings)
            throws InterruptedException {
        return execution.timeout() != null ? execution : execution.withTimeout(TimeLimit.of(
                SceneInfo.of(settings.problem().scene(), settings.problem().overrides(), execution.simulator()),
                settings.problem().duration()));
    }

    /** The execution with the longest of the time limits that suit several settings. */
    public static ExecutionSettings withTimeLimit(ExecutionSettings execution, Collection<EvolutionSettings> all)
            throws InterruptedException {
        Duration longest = Duration.ZERO;
        for (EvolutionSettings settings : all) {
            Duration limit = withTimeLimit(execution, settings).timeout();
            longest = longest.compareTo(limit) < 0 ? limit : longest;
        }
        return execution.withTimeout(longest);
    }

    /**
     * The evaluator that the settings ask for, with their cache; without it where the GPUs are other machines'. Several
     * runs can share it.
     *
     * @param execution with a time limit
     * @throws io.natator.protocol.RequestRejectedException if the simulator cannot be run
     */
    public static Evaluator open(ExecutionSettings execution) throws InterruptedException {
        Evaluator evaluator = Evaluator.open(execution);
        if (execution.cache() == null || !execution.isKnownHere()) {
            return evaluator;
        }
        try {
            return new CachedEvaluator(evaluator, new EvaluationCache(execution.cache()), execution);
        } catch (RuntimeException | InterruptedException e) {
            evaluator.close();
            throw e;
        }
    }

    /**
     * Evolves, and writes everything into the folder: after each evaluation, each generation, and at the end.
     *
     * @param execution how the evaluator works, for the record
     * @param evaluator carries out the evaluations; stays open
     * @param listeners told of the evolution's course
     * @throws io.natator.evolution.EvolutionStoppedException if the evaluator is closed, or the calling thread
     *                                                        interrupted; the run can be continued
     * @throws io.natator.evolution.EvolutionFailedException  if most simulations of a generation fail
     * @throws InvalidInputException                          if the scene was changed since the run was begun
     */
    public Outcome run(ExecutionSettings execution, Evaluator evaluator, EvolutionListener... listeners)
            throws InterruptedException {
        String digest = SceneDigest.of(settings, execution.simulator());
        SceneDigest.check(folder.directory(), settings, digest);
        if (!RunReader.isFinished(folder.directory())) {
            folder.write(Environment.present(execution, digest, settings));
        }
        // Runs that share an evaluator count for themselves what they find in its cache.
        CachedEvaluator cached = evaluator instanceof CachedEvaluator shared ? shared.counting() : null;
        Evaluator own = cached == null ? evaluator : cached;
        SceneInfo scene = SceneInfo.of(settings.problem().scene(), settings.problem().overrides(),
                execution.simulator());
        double duration = settings.problem().duration() != null ? settings.problem().duration() : scene.duration();
        EvaluationCounter counter = new EvaluationCounter(folder, duration, cached == null ? () -> 0 : cached::found);
        List<EvolutionListener> all = new ArrayList<>(List.of(folder, counter));
        if (settings.problem().vacuumCheck()) {
            all.add(new VacuumCheck(folder, own));
        }
        all.addAll(List.of(listeners));
        Evaluator checked = settings.problem().evolve() == null ? own
                : new BodyCheckEvaluator(own, settings, execution.simulator());
        EvolutionState state = new Evolution(settings, FitnessEvaluator.of(checked, settings, scene), all,
                folder.recorded(), pipe).run(folder.checkpoint());
        counter.generationFinished(state);  // a kill may have come between the last checkpoint and its count
        return outcome(state, own, scene, execution.simulator());
    }

    /** Writes what came of the run, its winner examined. */
    private Outcome outcome(EvolutionState state, Evaluator evaluator, SceneInfo scene, Path simulator)
            throws InterruptedException {
        BestGait known = RunReader.best(folder.directory());
        if (known != null && state.best() != null && known.isExamined(state.best())) {
            folder.writeTable(state);
            return new Outcome(state, known);
        }
        BestGait best = folder.writeResults(state);
        if (best != null) {
            best = examine(best, state.best(), new FreshStarts(settings, evaluator, simulator), evaluator,
                    best.body() == null ? scene.bodyLength()
                            : Double.valueOf(settings.problem().bodyLength(best.body())));
            folder.write(best);
        }
        return new Outcome(state, best);
    }

    /** The winner with what it does from fresh starts, and in vacuum for as long as it swam. */
    private BestGait examine(BestGait best, Individual winner, FreshStarts starts, Evaluator evaluator,
            Double bodyLength) throws InterruptedException {
        SimulationResult own = winner.runs() == 1 ? winner.result() : starts.fromOwnStart(winner);
        SimulationResult vacuum = VacuumCheck.drift(winner, settings, own.simulated(), evaluator);
        return best.withExamination(own, bodyLength, vacuum, starts.of(winner));
    }
}
