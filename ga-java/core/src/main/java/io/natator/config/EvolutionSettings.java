package io.natator.config;

import com.fasterxml.jackson.annotation.JsonCreator;
import com.fasterxml.jackson.annotation.JsonValue;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.soabase.recordbuilder.core.RecordBuilder;
import java.util.Arrays;
import java.util.List;
import java.util.stream.Collectors;

/**
 * All that determines the outcome of an evolution: the same settings and simulator give the same run. Written to
 * {@code config.json}; how it is executed (workers, time limit, paths) is not part of it. Made by
 * {@link #of(String, EncodingKind, int)}; settings that a file does not have are the defaults.
 *
 * @param problem what is to be evolved
 * @param search  how
 * @param budget  how far, and on what
 */
@RecordBuilder
public record EvolutionSettings(Problem problem, Search search, Budget budget)
        implements EvolutionSettingsBuilder.With {

    /**
     * Checks what depends on several of them.
     *
     * @throws InvalidInputException naming the settings that do not go together
     */
    public EvolutionSettings {
        checkObjectives(search.optimizer(), problem.fitness(), search.judge(),
                problem.objectives() == null ? List.of() : problem.objectives());
        Limits.require(budget.evaluations() == null || budget.evaluations() >= search.starts(), "evaluations",
                budget.evaluations(),
                "at least the " + search.starts() + " starts of one gait");
    }

    @JsonCreator(mode = JsonCreator.Mode.DELEGATING)
    static EvolutionSettings of(SettingsFile file) {
        return file.settings();
    }

    @JsonValue
    SettingsFile file() {
        return SettingsFile.of(this);
    }

    private static void checkObjectives(OptimizerKind optimizer, FitnessKind fitness, Aggregate judge,
            List<WeightedObjective> objectives) {
        long weighted = objectives.stream().filter(one -> one.weight() != null).count();
        String names = objectives.stream().map(one -> Json.name(one.objective())).collect(Collectors.joining(" and "));
        String name = "optimizer " + Json.name(optimizer);
        if (fitness != FitnessKind.DISTANCE && !objectives.isEmpty()) {
            throw new InvalidInputException(
                    "--fitness and --objectives exclude each other; expected the objective net");
        }
        if (weighted > 0 && weighted < objectives.size()) {
            throw new InvalidInputException(
                    "objectives are " + names + ", of which " + weighted + " have weights; expected all "
                            + "or none of them");
        }
        boolean several = optimizer.takesSeveralObjectives();
        if (several && (objectives.size() < 2 || weighted > 0)) {
            throw new InvalidInputException(name + " is for several objectives without weights, not "
                    + (objectives.isEmpty() ? "none" : names) + "; expected --objectives distance,work for example");
        }
        if (several && judge != Aggregate.MEAN) {
            throw new InvalidInputException(name + " judges by means; expected --judge mean");
        }
        if (!several && objectives.size() > 1 && weighted == 0) {
            String others = Arrays.stream(OptimizerKind.values()).filter(OptimizerKind::takesSeveralObjectives)
                    .map(Json::name).collect(Collectors.joining(" or "));
            throw new InvalidInputException(name + " has one objective, not " + names
                    + "; expected a weight for each, as in distance=1,work=0.1, or --optimizer " + others);
        }
    }

    /** The thesis' settings for a scene, with seed 1 and the corrected operators, on the processor. */
    public static EvolutionSettings of(String scene, EncodingKind encoding, int actuators) {
        return new EvolutionSettings(
                ProblemBuilder.builder().scene(scene).encoding(encoding).actuators(actuators).build(),
                SearchBuilder.builder().population(Preset.THESIS.population(scene)).seed(1).gaussianDeviation(0.05)
                        .build(),
                BudgetBuilder.builder().generations(Preset.THESIS.generations()).build());
    }

    /** These settings with another number of generations. */
    public EvolutionSettings withGenerations(int newGenerations) {
        return withBudget(budget.withGenerations(newGenerations));
    }

    /** These settings with another size. */
    public EvolutionSettings withSize(int newPopulation, int newGenerations) {
        return new EvolutionSettings(problem, search.withPopulation(newPopulation),
                budget.withGenerations(newGenerations));
    }

    /** These settings with another optimizer and, for JGAP, its operators. */
    public EvolutionSettings withOptimizer(OptimizerKind newOptimizer, OperatorSet newOperators,
            double newGaussianDeviation) {
        return withSearch(search.with(
                to -> to.optimizer(newOptimizer).operators(newOperators).gaussianDeviation(newGaussianDeviation)));
    }

    /** These settings with another reward, and with or without the check of new bests in vacuum. */
    public EvolutionSettings withFitness(FitnessKind newFitness, boolean newVacuumCheck) {
        return withProblem(problem.with(to -> to.fitness(newFitness).vacuumCheck(newVacuumCheck)));
    }

    /** These settings with the scene changed; null leaves what the scene has. */
    public EvolutionSettings withScene(Scheme newScheme, Double newDuration, JsonNode newOverrides) {
        return withProblem(problem.with(to -> to.scheme(newScheme).duration(newDuration).overrides(newOverrides)));
    }

    /** These settings with another number of starts of each gait. */
    public EvolutionSettings withStarts(int newStarts, Aggregate newJudge) {
        return withSearch(search.with(to -> to.starts(newStarts).judge(newJudge)));
    }

    /** These settings with objectives instead of the fitness, or null; and for these, an optimizer. */
    public EvolutionSettings withObjectives(OptimizerKind newOptimizer, List<WeightedObjective> newObjectives) {
        return new EvolutionSettings(problem.withObjectives(newObjectives), search.withOptimizer(newOptimizer), budget);
    }

    /** These settings with another seed of all random choices. */
    public EvolutionSettings withSeed(long newSeed) {
        return withSearch(search.withSeed(newSeed));
    }

    /** These settings with another number of simulations after which the run ends, or null. */
    public EvolutionSettings withEvaluations(Long newEvaluations) {
        return withBudget(budget.withEvaluations(newEvaluations));
    }

    /** These settings on another backend. */
    public EvolutionSettings withBackend(Backend newBackend) {
        return withBudget(budget.withBackend(newBackend));
    }

    /** These settings with bodies to be evolved, or null. */
    public EvolutionSettings withEvolve(BodyEvolution newEvolve) {
        return withProblem(problem.withEvolve(newEvolve));
    }
}
