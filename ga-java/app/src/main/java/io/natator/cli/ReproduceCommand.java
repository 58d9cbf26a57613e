package io.natator.cli;

import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.Scheme;
import io.natator.run.EvolutionRun;
import io.natator.study.thesis.EvolutionPlan;
import io.natator.study.thesis.ThesisStudy;
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
        description = {"Evolves the thesis' creatures in both schemes, measures what came out and writes the report.",
            "The same command continues where it was stopped."},
        footer = {"", "Examples:", "  natator reproduce --dry-run",
            "  natator reproduce --phase evolve --backend cuda --compact --stop-after 500"})
final class ReproduceCommand implements Callable<Integer> {

    /** What is to be done. */
    enum Phase { EVOLVE, MEASURE, REPORT, ALL }

    private static final double NANOSECONDS = 1e9;
    private static final List<String> WITHOUT_OUTCOME = List.of("--stop-after", "--simulator-path",
            "--simulator-command", "--master", "--workers", "--timeout", "--phase", "--runs-at-once", "--compact", "--device");

    @Spec
    private CommandSpec spec;

    @Mixin
    private ExecutionOptions executionOptions;

    @Mixin
    private QueueOptions queueOptions;

    @Section(Topic.SCENE)
    @Option(names = "--creature", paramLabel = "N", split = ",", defaultValue = "1,2,3,4",
            description = "Creatures of the thesis, 1 to 4. Default: ${DEFAULT-VALUE}.")
    private List<Integer> creatures;

    @Section(Topic.SCENE)
    @Option(names = "--scheme", paramLabel = "SCHEME", split = ",", defaultValue = "flex,conserving",
            description = "flex, conserving or both. In conserving the creatures sink, since they are heavier than its "
                    + "water. Default: ${DEFAULT-VALUE}.")
    private List<Scheme> schemes;

    @Section(Topic.EXTENT)
    @Option(names = "--seeds", paramLabel = "N", defaultValue = "3",
            description = "Evolutions of each creature in each scheme, from 1. Default: ${DEFAULT-VALUE}.")
    private int seeds;

    @Section(Topic.EXTENT)
    @Option(names = "--generations", paramLabel = "N", defaultValue = "100",
            description = "Generations after the random one, from 0. Default: ${DEFAULT-VALUE}.")
    private int generations;

    @Section(Topic.EXTENT)
    @Option(names = "--population", paramLabel = "N", defaultValue = "150",
            description = "Chromosomes selected in each generation, from 2. Default: ${DEFAULT-VALUE}.")
    private int population;

    @Section(Topic.SCENE)
    @Option(names = "--duration", paramLabel = "SECONDS",
            description = "Simulated time of an evaluation. Default: the scene's (4).")
    private Double duration;

    @Section(Topic.OUTPUT)
    @Option(names = "--output-dir", paramLabel = "DIR", defaultValue = "results/thesis",
            description = "Where runs, measurements and report go. Default: ${DEFAULT-VALUE}.")
    private Path directory;

    @Section(Topic.EXTENT)
    @Option(names = "--phase", paramLabel = "PHASE", defaultValue = "all",
            description = "evolve, measure, report or all. Default: ${DEFAULT-VALUE}.")
    private Phase phase;

    @Section(Topic.EXTENT)
    @Option(names = "--runs", paramLabel = "N", defaultValue = "5",
            description = "Runs of every measured gait, from 1, with starts that differ by 1e-6. "
                    + "Default: ${DEFAULT-VALUE}.")
    private int runs;

    @Section(Topic.OUTPUT)
    @Option(names = "--compact", description = "Drop the single evaluations of finished evolutions, some ten megabytes "
            + "each, which the same seed gives again.")
    private boolean compact;

    @Section(Topic.OTHER)
    @Option(names = "--dry-run", description = "Say what would be done and how long it would take; do nothing.")
    private boolean dryRun;

    @Override
    public Integer call() throws InterruptedException {
        Double stopAfter = queueOptions.stopAfter();
        ExecutionSettings execution = executionOptions.execution(Backend.CPU);
        EvolutionPlan plan = new EvolutionPlan(creatures, schemes, seeds, population, generations, duration,
                execution.backend(), execution.simulator(), directory);
        execution = EvolutionRun.withTimeLimit(execution, plan.runs().stream().filter(run -> run.seed() == 1)
                .map(run -> run.plan().settings()).toList());
        PrintWriter out = spec.commandLine().getOut();
        PrintWriter err = spec.commandLine().getErr();
        EvolvePhase evolution = new EvolvePhase(plan, execution);
        if (dryRun) {
            evolution.forecast(out);
            try (ThesisStudy study = new ThesisStudy(directory, plan, runs, duration)) {
                out.printf("then, of what is evolved so far, %d evaluations to measure and %d runs to record or time%n",
                        study.missingMeasurements(), study.missingRecordings());
            }
            return ExitCode.OK;
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
                    out.printf("%d evaluations and %d recordings or times left; the same command continues%n",
                            study.missingMeasurements(), study.missingRecordings());
                    return ExitCode.OK;
                }
            }
            if (phase == Phase.REPORT || phase == Phase.ALL) {
                Path simulator = execution.simulator();
                out.println(study.report(plan, CommandText.of(spec, WITHOUT_OUTCOME),
                        study.portrayed().map(run -> DrawnSwim.portrait(run, simulator)).orElse(null)));
            }
        }
        return ExitCode.OK;
    }
}
