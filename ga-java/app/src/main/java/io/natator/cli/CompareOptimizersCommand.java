package io.natator.cli;

import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.FitnessKind;
import io.natator.config.InvalidInputException;
import io.natator.config.Judge;
import io.natator.config.Limits;
import io.natator.run.EvolutionRun;
import io.natator.simulator.SceneInfo;
import io.natator.study.optimizer.OptimizerStudy;
import io.natator.study.optimizer.OptimizerVariant;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code natator compare-optimizers}: optimizers side by side at an equal number of evaluations. */
@Command(name = "compare-optimizers", mixinStandardHelpOptions = true,
        description = {"Runs optimizers on creatures with several seeds, each for the same number of evaluations, and "
            + "draws their best distance against the evaluations.",
            "Then runs the best gaits from fresh starts, and compares the optimizers by these, at equal evaluations and at equal "
            + "simulated time: medians with intervals, a rank test, an effect size.",
            "The same command continues a study that was stopped."},
        customSynopsis = "natator compare-optimizers --output-dir DIR [OPTIONS]",
        footer = {"", "Example:", "  natator compare-optimizers --output-dir runs/study --evaluations 600"})
final class CompareOptimizersCommand implements Callable<Integer> {

    private static final List<String> WITHOUT_OUTCOME =
            List.of("--stop-after", "--simulator-path", "--simulator-command", "--master", "--workers", "--timeout", "--no-cache",
                    "--compact");

    @Spec
    private CommandSpec spec;

    @Mixin
    private SceneOptions sceneOptions;

    @Mixin
    private ExecutionOptions executionOptions;

    @Mixin
    private CacheOptions cacheOptions;

    @Mixin
    private QueueOptions queueOptions;

    @Section(Topic.OUTPUT)
    @Option(names = "--output-dir", required = true, paramLabel = "DIR", description = "Where runs and results go.")
    private Path directory;

    @Section(Topic.OUTPUT)
    @Option(names = "--compact", description = "Keep of finished runs a line in DIR/SCENE.jsonl instead of a folder: "
            + "their single evaluations, a megabyte each, can be made again.")
    private boolean compact;

    @Section(Topic.SCENE)
    @Option(names = "--creatures", paramLabel = "N", split = ",", defaultValue = "1,2",
            description = "Creatures of the thesis, 1 to 4. Default: ${DEFAULT-VALUE}.")
    private List<Integer> creatures;

    @Section(Topic.SCENE)
    @Option(names = "--water", paramLabel = "NAME", defaultValue = "thesis",
            description = "Scenes NAME/creature-N: thesis, open-water or pool. Default: ${DEFAULT-VALUE}.")
    private String water;

    @Section(Topic.SCENE)
    @Option(names = "--scene", paramLabel = "NAME", split = ",", description = "Scenes, or files of them, in place of "
            + "--creatures and --water; results are named by the last part of each.")
    private List<String> named = List.of();

    @Section(Topic.EXTENT)
    @Option(names = "--starts", paramLabel = "K", defaultValue = "1", description = "Run every gait from so many starts, from 1; "
            + "see evolve. Default: ${DEFAULT-VALUE}.")
    private int starts;

    @Section(Topic.SEARCH)
    @Option(names = "--judge", paramLabel = "HOW", defaultValue = "mean", description = "What the runs of a gait are worth: "
            + "mean, median or lower-quartile. Default: ${DEFAULT-VALUE}.")
    private Judge judge;

    @Section(Topic.SEARCH)
    @Option(names = "--optimizers", paramLabel = "NAME", split = ",",
            defaultValue = "jgap-corrected,jgap-stock,cma-es,random", description = "Default: ${DEFAULT-VALUE}.")
    private List<String> optimizers;

    @Section(Topic.EXTENT)
    @Option(names = "--seeds", paramLabel = "N", defaultValue = "10",
            description = "Runs of each optimizer on each creature, from 1. Default: ${DEFAULT-VALUE}.")
    private int seeds;

    @Section(Topic.EXTENT)
    @Option(names = "--evaluations", paramLabel = "N", defaultValue = "600",
            description = "Evaluations of each run, from 1. Default: ${DEFAULT-VALUE}.")
    private long evaluations;

    @Section(Topic.SEARCH)
    @Option(names = "--population", paramLabel = "N", defaultValue = "24",
            description = "Chromosomes of JGAP, from 2. Default: ${DEFAULT-VALUE}.")
    private int population;

    @Section(Topic.SEARCH)
    @Option(names = "--cma-es-population", paramLabel = "N",
            description = "Points in a generation of CMA-ES, from 2. Default: 4 + 3 ln n with n genes.")
    private Integer cmaEsPopulation;

    @Section(Topic.SEARCH)
    @Option(names = "--fitness", paramLabel = "KIND", defaultValue = "distance", description = "What is rewarded: "
            + "distance, or net: less what the gait drifts forwards in vacuum. Default: ${DEFAULT-VALUE}.")
    private FitnessKind fitness;

    @Section(Topic.EXTENT)
    @Option(names = "--rank-starts", paramLabel = "N", description = "Run all gaits of each run's last generation from N fresh "
            + "starts, from 1, and tell how well they were ranked. Default: only the best gaits are run again.")
    private Integer rankStarts;

    @Override
    public Integer call() throws InterruptedException {
        queueOptions.stopAfter();
        ExecutionSettings execution = cacheOptions.in(executionOptions.execution(Backend.CPU));
        queueOptions.atOnce(execution);
        if (rankStarts != null) {
            Limits.checkCount("--rank-starts", rankStarts, Limits.STARTS);
        }
        Map<String, EvolutionSettings> scenes = scenes(execution);
        OptimizerStudy study = new OptimizerStudy(scenes, variants(), seeds, cmaEsPopulation,
                rankStarts == null ? 0 : rankStarts, directory);
        boolean all = queueOptions.carryOut(study::run, EvolutionRun.withTimeLimit(execution, scenes.values()),
                study.size(), study.finished(), study.evaluations(), study.recorded(), spec.commandLine().getErr());
        if (compact) {
            study.compact();
        }
        PrintWriter out = spec.commandLine().getOut();
        if (!all) {
            out.printf("%d of %d runs finished%s; the same command continues%n", study.finished(), study.size(),
                    study.finished() < study.size() ? "" : ", " + study.compared() + " of them run again from fresh starts");
        }
        out.println(study.report(CommandText.of(spec, WITHOUT_OUTCOME)));
        return ExitCode.OK;
    }

    private Map<String, EvolutionSettings> scenes(ExecutionSettings execution) throws InterruptedException {
        Map<String, EvolutionSettings> scenes = new LinkedHashMap<>();
        for (String scene : chosenScenes()) {
            EncodingKind encoding = EncodingKind.usualFor(scene);
            int actuators =
                    SceneInfo.toEvolve(scene, encoding, sceneOptions.overrides(), execution.simulator()).actuators();
            scenes.put(SceneOptions.shortName(scene), EvolutionSettings.of(scene, encoding, actuators)
                    .withSize(population, EvolutionSettings.NO_LIMIT).withEvaluations(evaluations)
                    .withFitness(fitness, false).withBackend(execution.backend()).withStarts(starts, judge)
                    .withScene(sceneOptions.scheme(), sceneOptions.duration(), sceneOptions.overrides()));
        }
        return scenes;
    }

    private List<String> chosenScenes() {
        if (!named.isEmpty()) {
            for (String other : List.of("--creatures", "--water")) {
                if (spec.commandLine().getParseResult().hasMatchedOption(other)) {
                    throw new InvalidInputException(other + " goes without --scene; leave one of them out");
                }
            }
            List<String> scenes = named.stream().map(scene -> SceneOptions.scene("--scene", scene)).toList();
            EachOnce.check("--scene", scenes.stream().map(SceneOptions::shortName).toList(), name -> name);
            return scenes;
        }
        EachOnce.check("--creatures", creatures, String::valueOf);
        return creatures.stream().map(creature -> {
            if (creature < 1 || creature > 4) {
                throw new InvalidInputException("--creatures has " + creature + "; expected 1, 2, 3 or 4");
            }
            return water + "/creature-" + creature;
        }).toList();
    }

    private List<OptimizerVariant> variants() {
        List<String> known = Arrays.stream(OptimizerVariant.values()).map(OptimizerVariant::label).toList();
        List<OptimizerVariant> variants = optimizers.stream().map(name -> {
            int index = known.indexOf(name.toLowerCase(Locale.ROOT));
            if (index < 0) {
                throw new InvalidInputException("--optimizers has " + name + "; expected some of "
                        + String.join(",", known));
            }
            return OptimizerVariant.values()[index];
        }).toList();
        EachOnce.check("--optimizers", variants, OptimizerVariant::label);
        return variants;
    }
}
