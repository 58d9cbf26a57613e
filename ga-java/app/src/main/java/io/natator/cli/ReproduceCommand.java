package io.natator.cli;

import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.config.Limits;
import io.natator.file.GeneratedPage;
import io.natator.run.EvolutionRun;
import io.natator.study.thesis.EvolutionPlan;
import io.natator.study.thesis.Repeated;
import io.natator.study.thesis.ThesisStudy;
import io.natator.study.thesis.Water;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code natator reproduce}: the thesis done again, from evolution to the report. */
@Command(name = "reproduce", mixinStandardHelpOptions = true,
        description = {"Evolves the thesis' creatures in its tank and in open water, measures what came out and writes the report.",
            "The same command continues where it was stopped."},
        footer = {"", "Examples:", "  natator reproduce --dry-run",
            "  natator reproduce --phase evolve --backend cuda --compact --stop-after 500",
            "  natator reproduce --phase repeat --water flex --sample 4"})
final class ReproduceCommand implements Callable<Integer> {

    /** What is to be done. */
    enum Phase { EVOLVE, MEASURE, REPORT, REPEAT, ALL }

    private static final List<Integer> CREATURES = List.of(1, 2, 3, 4);
    private static final double NANOSECONDS = 1e9;

    @Spec
    private CommandSpec spec;

    @Mixin
    private ExecutionOptions executionOptions;

    @Mixin
    private QueueOptions queueOptions;

    @Section(Topic.SCENE)
    @Option(names = "--creature", paramLabel = "N", split = ",", description = "Creatures of the thesis, 1 to 4. Default: all.")
    private List<Integer> creatures = CREATURES;

    @Section(Topic.SCENE)
    @Option(names = "--water", paramLabel = "WATER", split = ",", defaultValue = "flex,open-water",
            description = "flex (the thesis' tank), open-water (incompressible water, scheme conserving) or both. Default: "
                    + "${DEFAULT-VALUE}.")
    private List<Water> waters;

    @Section(Topic.EXTENT)
    @Option(names = "--seeds", paramLabel = "N",
            description = "Evolutions of each creature in each water, from 1. Default: " + EvolutionPlan.USUAL_SEEDS
                    + ", or in each water as many as DIR holds finished, if more.")
    private Integer seeds;

    @Section(Topic.EXTENT)
    @Option(names = "--generations", paramLabel = "N",
            description = "Generations after the random one, from 0; evolutions of fewer go on. Default: 25, or those of the evolutions in DIR.")
    private Integer generations;

    @Section(Topic.EXTENT)
    @Option(names = "--population", paramLabel = "N",
            description = "Chromosomes selected in each generation, from 2. Default: 150 in flex, 60 in open water, or that of the "
                    + "evolutions in DIR.")
    private Integer population;

    @Section(Topic.EXTENT)
    @Option(names = "--starts", paramLabel = "K", description = "Runs of each new gait of an evolution, each from a start of its "
            + "own. Default: 2, or those of the evolutions in DIR.")
    private Integer starts;

    @Section(Topic.SCENE)
    @Option(names = "--duration", paramLabel = "SECONDS",
            description = "Simulated time of a run. Default: the scene's (4); while evolving in open water 1.75, of "
                    + "creature 2 2.5, or that of the evolutions in DIR.")
    private Double duration;

    @Section(Topic.OUTPUT)
    @Option(names = "--output-dir", paramLabel = "DIR", defaultValue = "results/thesis",
            description = "Where runs, measurements and report go. Default: ${DEFAULT-VALUE}.")
    private Path directory;

    @Section(Topic.EXTENT)
    @Option(names = "--phase", paramLabel = "PHASE", defaultValue = "all",
            description = "evolve, measure, report or all; or repeat: run some of what was measured on the processor again and "
                    + "compare its last bit. Default: ${DEFAULT-VALUE}.")
    private Phase phase;

    @Section(Topic.EXTENT)
    @Option(names = "--sample", paramLabel = "N", defaultValue = "6",
            description = "How many runs --phase repeat draws, from 1. Default: ${DEFAULT-VALUE}.")
    private int sample;

    @Section(Topic.EXTENT)
    @Option(names = "--sample-seed", paramLabel = "N", defaultValue = "1", description = "By which chance. Default: ${DEFAULT-VALUE}.")
    private long sampleSeed;

    @Section(Topic.EXTENT)
    @Option(names = "--runs", paramLabel = "N", defaultValue = "8",
            description = "Runs of every measured gait in its water, from 1, each from a start of its own; of other experiments at "
                    + "most 4. Default: ${DEFAULT-VALUE}.")
    private int runs;

    @Section(Topic.OUTPUT)
    @Option(names = "--compact", description = "Drop the single evaluations of finished evolutions, some ten megabytes "
            + "each, which the same seed gives again; the last population stays, so that they can go on to more generations. Of "
            + "gaits that are finalists no more since, drop what was measured, once all of DIR is.")
    private boolean compact;

    @Section(Topic.OTHER)
    @Option(names = "--dry-run", description = "Say what would be done and how long it would take; do nothing.")
    private boolean dryRun;

    @Override
    public Integer call() throws InterruptedException {
        Double stopAfter = queueOptions.stopAfter();
        Limits.checkCount("--runs", runs, Limits.REPETITIONS);
        EachOnce.check("--creature", creatures, String::valueOf);
        EachOnce.check("--water", waters, EnumNames::of);
        GeneratedPage.check(directory);
        ExecutionSettings execution = executionOptions.execution(Backend.CPU);
        EvolutionPlan plan = new EvolutionPlan(creatures, waters, seeds,
                new EvolutionPlan.Size(population, generations, starts, duration), execution.backend(), execution.simulator(), directory);
        execution = EvolutionRun.withTimeLimit(execution, plan.runs().stream().filter(run -> run.seed() == 1)
                .map(run -> run.plan().settings()).toList());
        PrintWriter out = spec.commandLine().getOut();
        PrintWriter err = spec.commandLine().getErr();
        EvolvePhase evolution = new EvolvePhase(plan, execution);
        if (dryRun) {
            try (ThesisStudy study = new ThesisStudy(directory, plan, runs, duration)) {
                evolution.forecast(out);
                out.printf("then, of what is evolved so far, %d evaluations to measure, %d gaits to run at half the spacing and %d runs to "
                        + "record%n", study.missingMeasurements(), study.missingLevels(), study.missingRecordings());
            }
            return ExitCode.OK;
        }
        if (phase == Phase.REPEAT) {
            return repeat(plan, execution, out);
        }
        long started = System.nanoTime();
        if (phase == Phase.EVOLVE || phase == Phase.ALL) {
            if (!evolution.run(queueOptions, compact, err)) {
                out.printf("%d of %d evolutions finished; the same command continues%n", plan.finished().size(),
                        plan.runs().size());
                return ExitCode.OK;
            }
        }
        try (ThesisStudy study = new ThesisStudy(directory, plan, runs, duration)) {
            if (phase == Phase.MEASURE || phase == Phase.ALL) {
                Double left = stopAfter == null ? null
                        : Math.max(1, stopAfter - (System.nanoTime() - started) / NANOSECONDS);
                if (!new MeasurePhase(study, execution).run(left, err)) {
                    out.printf("%d evaluations, %d gaits at half the spacing and %d recordings left; the same command continues%n",
                            study.missingMeasurements(), study.missingLevels(), study.missingRecordings());
                    return ExitCode.OK;
                }
            }
            if (phase == Phase.REPORT || phase == Phase.ALL) {
                out.println(study.report(plan, new ReproduceCommands(spec, directory).of(plan)));
            }
        }
        if (compact && phase != Phase.EVOLVE) {
            dropOutdated(execution, err);
        }
        return ExitCode.OK;
    }

    /** Of all evolutions in the folder, also those that were not asked for. */
    private void dropOutdated(ExecutionSettings execution, PrintWriter err) throws InterruptedException {
        if (EvolutionPlan.isAnyUnderWay(directory)) {
            return;
        }
        EvolutionPlan all = new EvolutionPlan(CREATURES, List.of(Water.values()), null,
                new EvolutionPlan.Size(population, null, starts, duration), execution.backend(), execution.simulator(), directory);
        try (ThesisStudy study = new ThesisStudy(directory, all, runs, duration)) {
            int dropped = study.dropOutdated();
            if (dropped > 0) {
                err.printf("dropped %d rows of gaits that are finalists no more%n", dropped);
            }
        }
    }

    /** Whether the present program still makes what is stored. */
    private int repeat(EvolutionPlan plan, ExecutionSettings execution, PrintWriter out) throws InterruptedException {
        Limits.checkCount("--sample", sample, Limits.REPETITIONS);
        try (ThesisStudy study = new ThesisStudy(directory, plan, runs, duration)) {
            List<Repeated> repeated = study.repeat(waters, sample, sampleSeed, execution);
            if (repeated.isEmpty()) {
                throw new InvalidInputException(directory + " holds no runs to do again; expected what --phase measure keeps in processor.jsonl");
            }
            repeated.stream().filter(one -> !one.isSame()).forEach(one -> out.println("differs: " + Json.line(one.request()) + " ended as "
                    + one.stored() + ", now as " + one.now()));
            long same = repeated.stream().filter(Repeated::isSame).count();
            out.printf("%d of %d runs end with the same bits%n", same, repeated.size());
            return same == repeated.size() ? ExitCode.OK : ExitCode.SOFTWARE;
        }
    }
}
