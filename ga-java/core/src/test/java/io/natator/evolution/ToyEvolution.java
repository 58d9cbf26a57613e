package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.config.OptimizerKind;
import io.natator.config.WeightedObjective;
import io.natator.fitness.FitnessEvaluator;
import io.natator.process.Evaluator;
import io.natator.process.FakePool;
import io.natator.process.SceneInfo;
import java.util.ArrayList;
import java.util.List;

/** Evolutions with {@link ToySimulator}. */
public final class ToyEvolution {

    /** Of the toy's body. */
    static final double BODY_LENGTH = 0.8;

    private ToyEvolution() {
    }

    /** By this optimizer, with objectives where it takes several. */
    public static EvolutionSettings by(OptimizerKind optimizer, EvolutionSettings settings) {
        return settings.withObjectives(optimizer,
                optimizer == OptimizerKind.NSGA2 ? WeightedObjective.parse("distance,work") : null);
    }

    static EvolutionState run(EvolutionSettings settings, int workers, EvolutionState from,
            List<EvaluationRecord> recorded, EvolutionListener... listeners) {
        return run(settings, new ToySimulator(), workers, from, recorded, listeners);
    }

    /** From its beginning. */
    static Recorder run(EvolutionSettings settings) {
        Recorder recorder = new Recorder();
        run(settings, 2, null, List.of(), recorder);
        return recorder;
    }

    /** From its beginning, with another simulator. */
    static EvolutionState run(EvolutionSettings settings, FakePool.Simulation simulator,
            EvolutionListener... listeners) {
        return run(settings, simulator, 2, null, List.of(), listeners);
    }

    private static EvolutionState run(EvolutionSettings settings, FakePool.Simulation simulator, int workers,
            EvolutionState from, List<EvaluationRecord> recorded, EvolutionListener... listeners) {
        try (ToyOptimizer optimizer = settings.search().optimizer().isOutside() ? new ToyOptimizer() : null) {
            return run(settings, simulator, optimizer, workers, from, recorded, listeners);
        }
    }

    /** By an optimizer outside the program, or null. */
    static EvolutionState run(EvolutionSettings settings, FakePool.Simulation simulator, ToyOptimizer optimizer,
            int workers, EvolutionState from, List<EvaluationRecord> recorded, EvolutionListener... listeners) {
        try (Evaluator pool = new FakePool(simulator, workers)) {
            return new Evolution(settings, evaluator(settings, pool), List.of(listeners),
                    new RecordedEvaluations(0, recorded), optimizer == null ? null : optimizer.pipe).run(from);
        }
    }

    /** What measures all that the settings ask for. */
    static Evaluator evaluator(EvolutionSettings settings, Evaluator toy) {
        return FitnessEvaluator.of(toy, settings, new SceneInfo("toy", 2, 1, 4, 1 / 60.0, 4, 4, BODY_LENGTH, 1, null));
    }

    /** Keeps all that a run folder keeps. */
    public static final class Recorder implements EvolutionListener {
        public final List<EvolutionState> states = new ArrayList<>();
        public final List<EvaluationRecord> evaluations = new ArrayList<>();
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

        /** The run's last state. */
        EvolutionState end() {
            return states.get(states.size() - 1);
        }

        List<EvaluationRecord> of(int generation) {
            return evaluations.stream().filter(one -> one.generation() == generation).toList();
        }
    }
}
