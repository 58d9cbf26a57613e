package io.natator.cli;

import io.natator.cli.Section.Topic;
import io.natator.config.Budget;
import io.natator.config.EvolutionSettings;
import io.natator.config.Judge;
import io.natator.config.Preset;
import picocli.CommandLine.Option;

/** Options that say how much an evolution simulates. */
@Section(Topic.EXTENT)
final class SizeOptions {

    @Option(names = "--preset", paramLabel = "PRESET", defaultValue = "quick",
            description = "quick (population 16, 3 generations of 2 s in pool/creature-N, 1 start) or thesis (150, 100, "
                    + "as thesis/creature-N has it, 4 starts). Other options change parts of it. "
                    + "Default: ${DEFAULT-VALUE}.")
    private Preset preset;

    @Option(names = "--population", paramLabel = "N", description = "Chromosomes selected in each generation, from 2.")
    private Integer population;

    @Option(names = "--generations", paramLabel = "N", description = "Generations after the random one, from 0.")
    private Integer generations;

    @Option(names = "--evaluations", paramLabel = "N",
            description = "End after so many evaluations, from 1; of several starts, with the last whole gait. "
                    + "Default: what the generations take.")
    private Long evaluations;

    @Option(names = "--starts", paramLabel = "K", description = "Run every gait from so many starts, from 1, and the best "
            + "of each generation again from others; 1 is the scene's own start, once. Default: the preset's.")
    private Integer starts;

    @Section(Topic.SEARCH)
    @Option(names = "--judge", paramLabel = "HOW", defaultValue = "mean", description = "What the runs of a gait are worth: "
            + "mean, median (from 3 starts) or lower-quartile (from 4). Default: ${DEFAULT-VALUE}.")
    private Judge judge;

    /** What is meant where no other option says otherwise. */
    Preset preset() {
        return preset;
    }

    /** The settings with this size. */
    EvolutionSettings in(EvolutionSettings settings) {
        return settings.withSize(population != null ? population : preset.population(), generations()).withEvaluations(evaluations)
                .withStarts(starts != null ? starts : preset.starts(), judge);
    }

    /** With a number of evaluations alone, that is what ends the run. */
    private int generations() {
        return generations != null ? generations
                : evaluations != null ? Budget.NO_LIMIT : preset.generations();
    }
}
