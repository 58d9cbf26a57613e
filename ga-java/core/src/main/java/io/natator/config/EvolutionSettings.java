package io.natator.config;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.base.Numbers;
import io.natator.body.Genome;
import io.natator.encoding.Encoding;
import io.soabase.recordbuilder.core.RecordBuilder;
import java.util.List;
import java.util.Locale;
import java.util.Objects;
import java.util.stream.Collectors;

/**
 * All that determines the outcome of an evolution: the same settings and simulator give the same run. Written to
 * {@code config.json}; how it is executed (workers, time limit, paths) is not part of it. Made by
 * {@link #of(String, EncodingKind, int)}; settings that a file does not have are the defaults.
 *
 * @param scene             name or path of the scene
 * @param encoding          how genes stand for a gait
 * @param actuators         number of actuators of the scene's creature
 * @param optimizer         what searches
 * @param population        chromosomes at the start and selected in each generation (thesis: 150); for the other
 *                          optimizers the evaluations of a generation; from 2 to {@link Limits#POPULATION}
 * @param generations       generations bred after the random one, at least 0 (thesis: 100)
 * @param evaluations       simulations after which the run ends, within a generation if need be, at least 1; null for
 *                          as many as the generations take
 * @param seed              of all random choices
 * @param operators         which genetic operators to use
 * @param gaussianDeviation deviation of the Gaussian mutation as a share of the gene's range, above 0; JGAP's own: 0.05
 * @param fitness           what selection rewards
 * @param vacuumCheck       whether the best of a generation, where it is a new best, is also run in vacuum
 * @param backend           what the simulator computes on
 * @param scheme            scheme to ask the simulator for, or null for the scene's own
 * @param duration          simulated time in seconds, above 0, or null for the scene's own
 * @param overrides         JSON Merge Patch on the scene, or null
 * @param starts            runs of each new gait, each from a start of its own, from 1 to {@link Limits#STARTS}; 1 is one
 *                          run from the scene's own start, as in the thesis
 * @param judge             what several runs are worth
 * @param objectives        what is to be great instead of the fitness: one, several with weights, or for {@code nsga2}
 *                          several without; null for the fitness
 * @param evolve            bodies to be evolved; null for gaits of the scene's body alone
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
@RecordBuilder
public record EvolutionSettings(String scene, EncodingKind encoding, int actuators, OptimizerKind optimizer,
        int population, int generations, Long evaluations, long seed, OperatorSet operators, double gaussianDeviation,
        FitnessKind fitness, Boolean vacuumCheck, Backend backend, Scheme scheme, Double duration,
        JsonNode overrides, Integer starts, Judge judge, List<WeightedObjective> objectives, BodyEvolution evolve)
        implements EvolutionSettingsBuilder.With {

    /** Generations of a run that ends by its number of evaluations alone. */
    public static final int NO_LIMIT = Integer.MAX_VALUE;

    /** Elites of 150 selected chromosomes (thesis 2.6). */
    private static final double ELITE_SHARE = 30.0 / 150.0;

    /**
     * Checks the ranges and fills in defaults.
     *
     * @throws InvalidInputException naming the setting that is out of range
     */
    public EvolutionSettings {
        Objects.requireNonNull(scene, "scene");
        Objects.requireNonNull(encoding, "encoding");
        require(actuators <= Limits.ACTUATORS, "actuators", actuators, "at most " + Limits.ACTUATORS);
        encoding.forActuators(actuators);  // refuses what it cannot be of
        operators = operators == null ? OperatorSet.CORRECTED : operators;
        require(population >= 2 && population <= Limits.POPULATION, "population", population,
                "a whole number from 2 to " + Limits.POPULATION);
        require(generations >= 0, "generations", generations, "a whole number from 0");
        require(evaluations == null || evaluations >= 1, "evaluations", evaluations, "a whole number from 1");
        require(gaussianDeviation > 0 && gaussianDeviation <= 1, "gaussian-deviation", gaussianDeviation,
                "a number above 0 and up to 1");
        if (duration != null) {
            Limits.checkDuration("duration", duration);
        }
        optimizer = optimizer == null ? OptimizerKind.JGAP : optimizer;
        fitness = fitness == null ? FitnessKind.DISTANCE : fitness;
        vacuumCheck = vacuumCheck != null && vacuumCheck;
        backend = backend == null ? Backend.CPU : backend;
        starts = starts == null ? 1 : starts;
        judge = judge == null ? Judge.MEAN : judge;
        require(starts >= 1 && starts <= Limits.STARTS, "starts", starts, "a whole number from 1 to " + Limits.STARTS);
        require(starts >= judge.leastRuns(), "starts", starts,
                "at least " + judge.leastRuns() + " with --judge " + judge.name().toLowerCase(Locale.ROOT).replace('_', '-'));
        objectives = objectives == null || objectives.isEmpty() ? null : List.copyOf(objectives);
        checkObjectives(optimizer, fitness, judge, objectives == null ? List.of() : objectives);
        require(evolve == null || evolve.gait() == null || evolve.gait().actuators() == actuators, "gait of the bodies",
                evolve == null || evolve.gait() == null ? "" : "for " + Numbers.count(evolve.gait().actuators(), "actuator"),
                "one for the " + actuators + " of the scene's body");
        require(evaluations == null || evaluations >= starts, "evaluations", evaluations,
                "at least the " + starts + " starts of one gait");
    }

    private static void checkObjectives(OptimizerKind optimizer, FitnessKind fitness, Judge judge,
            List<WeightedObjective> objectives) {
        long weighted = objectives.stream().filter(one -> one.weight() != null).count();
        String names = objectives.stream().map(one -> one.objective().name().toLowerCase(Locale.ROOT))
                .collect(Collectors.joining(" and "));
        String name = optimizer.name().toLowerCase(Locale.ROOT).replace('_', '-');
        if (fitness != FitnessKind.DISTANCE && !objectives.isEmpty()) {
            throw new InvalidInputException("--fitness and --objectives exclude each other; expected the objective net");
        }
        if (weighted > 0 && weighted < objectives.size()) {
            throw new InvalidInputException("objectives are " + names + ", of which " + weighted + " have weights; expected all "
                    + "or none of them");
        }
        if (optimizer == OptimizerKind.NSGA2 && (objectives.size() < 2 || weighted > 0)) {
            throw new InvalidInputException("optimizer nsga2 is for several objectives without weights, not "
                    + (objectives.isEmpty() ? "none" : names) + "; expected --objectives distance,work for example");
        }
        if (optimizer == OptimizerKind.NSGA2 && judge != Judge.MEAN) {
            throw new InvalidInputException("optimizer nsga2 judges by means; expected --judge mean");
        }
        if (optimizer != OptimizerKind.NSGA2 && objectives.size() > 1 && weighted == 0) {
            throw new InvalidInputException("optimizer " + name + " has one objective, not " + names
                    + "; expected a weight for each, as in distance=1,work=0.1, or --optimizer nsga2");
        }
    }

    private static void require(boolean valid, String name, Object value, String expected) {
        if (!valid) {
            throw new InvalidInputException(name + " is " + value + "; expected " + expected);
        }
    }

    /** The thesis' settings for a scene, with seed 1 and the corrected operators, on the processor. */
    public static EvolutionSettings of(String scene, EncodingKind encoding, int actuators) {
        return EvolutionSettingsBuilder.builder().scene(scene).encoding(encoding).actuators(actuators).population(Preset.THESIS.population())
                .generations(Preset.THESIS.generations()).seed(1).gaussianDeviation(0.05).build();
    }

    /** These settings with another number of generations. */
    public EvolutionSettings withGenerations(int newGenerations) {
        return with(to -> to.generations(newGenerations));
    }

    /** These settings with another size. */
    public EvolutionSettings withSize(int newPopulation, int newGenerations) {
        return with(to -> to.population(newPopulation).generations(newGenerations));
    }

    /** These settings with another optimizer and, for JGAP, its operators. */
    public EvolutionSettings withOptimizer(OptimizerKind newOptimizer, OperatorSet newOperators,
            double newGaussianDeviation) {
        return with(to -> to.optimizer(newOptimizer).operators(newOperators).gaussianDeviation(newGaussianDeviation));
    }

    /** These settings with another reward, and with or without the check of new bests in vacuum. */
    public EvolutionSettings withFitness(FitnessKind newFitness, boolean newVacuumCheck) {
        return with(to -> to.fitness(newFitness).vacuumCheck(newVacuumCheck));
    }

    /** These settings with the scene changed; null leaves what the scene has. */
    public EvolutionSettings withScene(Scheme newScheme, Double newDuration, JsonNode newOverrides) {
        return with(to -> to.scheme(newScheme).duration(newDuration).overrides(newOverrides));
    }

    /** These settings with another number of starts of each gait. */
    public EvolutionSettings withStarts(int newStarts, Judge newJudge) {
        return with(to -> to.starts(newStarts).judge(newJudge));
    }

    /** These settings with objectives instead of the fitness, or null; and for these, an optimizer. */
    public EvolutionSettings withObjectives(OptimizerKind newOptimizer, List<WeightedObjective> newObjectives) {
        return with(to -> to.optimizer(newOptimizer).objectives(newObjectives));
    }

    /** What a gait is worth in this run, for people: a distance has four decimals, and may be nothing. */
    public String worthText(double worth) {
        return objectives == null ? Numbers.fixed(worth, 4) : Numbers.worth(worth);
    }

    /** What genes stand for in this run. */
    public Genome genome() {
        Encoding gaits = encoding.forActuators(actuators);
        return evolve == null ? Genome.ofGait(gaits) : evolve.genome(gaits);
    }

    /**
     * Length of a body that this run evolves.
     *
     * @param patch that gives the scene this body
     */
    public double bodyLength(JsonNode patch) {
        return evolve.body().with(patch).bodyLength();
    }

    /** Runs of a generation that go to the best gaits so far, to know them better; none with a single start. */
    public int repeats() {
        return starts == 1 ? 0 : Math.max(elites(), 1) * starts;
    }

    /** How many of the selected are the best; 30 of 150 as in the thesis, the same share of other populations. */
    public int elites() {
        return (int) Math.round(ELITE_SHARE * population);
    }
}
