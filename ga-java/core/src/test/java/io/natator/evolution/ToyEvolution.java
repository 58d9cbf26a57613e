package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.config.OptimizerKind;
import io.natator.config.WeightedObjective;
import io.natator.fitness.EffortEvaluator;
import io.natator.fitness.ObjectiveEvaluator;
import io.natator.process.Evaluator;
import io.natator.process.WorkerPool;
import java.util.ArrayList;
import java.util.List;

/** Evolutions with {@link ToySimulator}. */
final class ToyEvolution {

    /** Of the toy's body. */
    static final double BODY_LENGTH = 0.8;

    private ToyEvolution() {
    }

    /** By this optimizer, with objectives where it takes several. */
    static EvolutionSettings by(OptimizerKind optimizer, EvolutionSettings settings) {
        return settings.withObjectives(optimizer,
                optimizer == OptimizerKind.NSGA2 ? WeightedObjective.parse("distance,work") : null);
    }

    static EvolutionState run(EvolutionSettings settings, int workers, EvolutionState from,
            List<EvaluationRecord> recorded, EvolutionListener... listeners) {
        try (WorkerPool pool = new WorkerPool(new ToySimulator(), workers)) {
            return new Evolution(settings, evaluator(settings, pool), List.of(listeners), new Recorded(0, recorded)).run(from);
        }
    }

    /** What measures all that the settings ask for. */
    static Evaluator evaluator(EvolutionSettings settings, Evaluator toy) {
        Evaluator worth = settings.problem().objectives() == null ? toy : new ObjectiveEvaluator(toy, settings.problem().objectives());
        return settings.search().optimizer() == OptimizerKind.MAP_ELITES ? EffortEvaluator.of(worth, BODY_LENGTH) : worth;
    }

    /** Keeps all that a run folder keeps. */
    static final class Recorder implements EvolutionListener {
        final List<EvolutionState> states = new ArrayList<>();
        final List<EvaluationRecord> evaluations = new ArrayList<>();
        final List<Integer> announced = new ArrayList<>();

        @Override
        public void generationStarted(int generation, int simulations) {
            announced.add(simulations);
        }

        @Override
        public void evaluated(EvaluationRecord evaluation) {
            evaluations.add(evaluation);
        }

        @Override
        public void generationFinished(EvolutionState state) {
            states.add(state);
        }

        List<EvaluationRecord> of(int generation) {
            return evaluations.stream().filter(one -> one.generation() == generation).toList();
        }
    }
}
