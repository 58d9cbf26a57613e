package io.natator.cli;

import io.natator.checkpoint.CompactRun;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Scheme;
import io.natator.config.SimulatorMode;
import io.natator.evolution.EvolutionListener;
import io.natator.run.EvolutionRun;
import io.natator.run.RunQueue;
import io.natator.simulator.Evaluator;
import io.natator.study.thesis.EvolutionPlan;
import io.natator.study.thesis.EvolvedRun;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Locale;
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
            "The same command continues where it was stopped."})
final class ReproduceCommand implements Callable<Integer> {

    private static final int RUNS_AT_ONCE = 2;
    private static final int RUNS_AT_ONCE_IN_BATCHES = 32;
    /** Evaluations of a generation as a share of the population (measured on JGAP: 1.49). */
    private static final double CHILDREN_PER_SELECTED = 1.5;
    private static final double THESIS_SECONDS = 4;

    /** What is to be done. */
    enum Phase { EVOLVE, ALL }

    @Spec
    private CommandSpec spec;

    @Mixin
    private ExecutionOptions executionOptions;

    @Option(names = "--creature", paramLabel = "N", split = ",", defaultValue = "1,2,3,4",
            description = "Creatures of the thesis, 1 to 4. Default: ${DEFAULT-VALUE}.")
    private List<Integer> creatures;

    @Option(names = "--scheme", paramLabel = "SCHEME", split = ",", defaultValue = "flex,conserving",
            description = "flex, conserving or both. Default: ${DEFAULT-VALUE}.")
    private List<Scheme> schemes;

    @Option(names = "--seeds", paramLabel = "N", defaultValue = "3",
            description = "Evolutions of each creature in each scheme, from 1. Default: ${DEFAULT-VALUE}.")
    private int seeds;

    @Option(names = "--generations", paramLabel = "N", defaultValue = "100",
            description = "Generations after the random one, from 0. Default: ${DEFAULT-VALUE}.")
    private int generations;

    @Option(names = "--population", paramLabel = "N", defaultValue = "150",
            description = "Chromosomes selected in each generation, from 2. Default: ${DEFAULT-VALUE}.")
    private int population;

    @Option(names = "--duration", paramLabel = "SECONDS",
            description = "Simulated time of an evaluation. Default: the scene's (4).")
    private Double duration;

    @Option(names = "--output-dir", paramLabel = "DIR", defaultValue = "results/thesis",
            description = "Where runs, measurements and report go. Default: ${DEFAULT-VALUE}.")
    private Path directory;

    @Option(names = "--phase", paramLabel = "PHASE", defaultValue = "all",
            description = "${COMPLETION-CANDIDATES}. Default: ${DEFAULT-VALUE}.")
    private Phase phase;

    @Option(names = "--runs-at-once", paramLabel = "N", description = "Evolutions under way at the same time; their "
            + "generations share a batch. Default: " + RUNS_AT_ONCE_IN_BATCHES + " with --simulator batch, else "
            + RUNS_AT_ONCE + ".")
    private Integer runsAtOnce;

    @Option(names = "--compact", description = "Drop the single evaluations of finished evolutions, some ten megabytes "
            + "each, which the same seed gives again.")
    private boolean compact;

    @Option(names = "--stop-after", paramLabel = "SECONDS", description = "Stop then, to be continued.")
    private Double stopAfter;

    @Option(names = "--dry-run", description = "Say what would be done and how long it would take; do nothing.")
    private boolean dryRun;

    @Override
    public Integer call() throws InterruptedException {
        EvolveCommand.checkStopAfter(stopAfter);
        ExecutionSettings execution = executionOptions.execution(Backend.CPU);
        EvolutionPlan plan = new EvolutionPlan(creatures, schemes, seeds, population, generations, duration,
                execution.backend(), execution.simulator(), directory);
        execution = withTimeLimit(execution, plan);
        if (dryRun) {
            forecast(plan, execution);
            return ExitCode.OK;
        }
        boolean all = evolve(plan, execution);
        if (!all) {
            spec.commandLine().getOut().printf("%d of %d evolutions finished; the same command continues%n",
                    plan.finished().size(), plan.runs().size());
        }
        return ExitCode.OK;
    }

    private boolean evolve(EvolutionPlan plan, ExecutionSettings execution) throws InterruptedException {
        PrintWriter err = spec.commandLine().getErr();
        int atOnce = runsAtOnce != null ? runsAtOnce
                : execution.mode() == SimulatorMode.BATCH ? RUNS_AT_ONCE_IN_BATCHES : RUNS_AT_ONCE;
        if (atOnce < 1) {
            throw new InvalidInputException("--runs-at-once is " + atOnce + "; expected a whole number from 1");
        }
        long recorded = plan.runs().stream().mapToLong(run -> run.plan().recorded()).sum();
        try (Evaluator evaluator = EvolutionRun.open(execution);
                Stopper stopper = new Stopper(evaluator, stopAfter, () -> {
                    err.println("interrupted; the same command continues");
                    err.flush();
                })) {
            StudyProgress progress = new StudyProgress(plan.runs().size(), plan.finished().size(),
                    recorded + left(plan), recorded, err) {
                @Override
                public EvolutionListener forRun() {
                    return execution.mode() == SimulatorMode.BATCH ? stopper.beforeLateGenerations()
                            : new EvolutionListener() { };
                }
            };
            return new RunQueue(plan.runs().stream().map(EvolvedRun::plan).toList())
                    .run(execution, evaluator, atOnce, progress);
        } finally {
            if (compact) {
                plan.finished().forEach(run -> CompactRun.compact(run.plan().directory()));
            }
        }
    }

    /** Evaluations that are still to be done, as far as can be known. */
    private static long left(EvolutionPlan plan) {
        return plan.runs().stream().filter(run -> !run.plan().isFinished())
                .mapToLong(run -> Math.max(0, expected(run.plan().settings()) - run.plan().recorded())).sum();
    }

    private static long expected(EvolutionSettings settings) {
        return Math.round(settings.population() * (1 + CHILDREN_PER_SELECTED * settings.generations()));
    }

    /** The longest of the limits that suit the scenes, unless one was given. */
    private static ExecutionSettings withTimeLimit(ExecutionSettings execution, EvolutionPlan plan)
            throws InterruptedException {
        Duration longest = Duration.ZERO;
        for (EvolvedRun run : plan.runs()) {
            if (run.seed() == 1) {
                Duration limit = EvolutionRun.withTimeLimit(execution, run.plan().settings()).timeout();
                longest = longest.compareTo(limit) < 0 ? limit : longest;
            }
        }
        return execution.withTimeout(longest);
    }

    private void forecast(EvolutionPlan plan, ExecutionSettings execution) throws InterruptedException {
        PrintWriter out = spec.commandLine().getOut();
        out.printf("%d evolutions in %s, %d of them finished; about %d evaluations left%n", plan.runs().size(),
                directory, plan.finished().size(), left(plan));
        int together = execution.mode() == SimulatorMode.BATCH ? population : execution.workers();
        double seconds = 0;
        try (Evaluator evaluator = Evaluator.open(execution)) {
            for (int creature : creatures) {
                for (Scheme scheme : schemes) {
                    List<EvolvedRun> cell = plan.runs().stream()
                            .filter(run -> run.creature() == creature && run.scheme() == scheme).toList();
                    long evaluations = cell.stream().filter(run -> !run.plan().isFinished())
                            .mapToLong(run -> Math.max(0, expected(run.plan().settings()) - run.plan().recorded())).sum();
                    double each = new EvaluationTime(cell.get(0).plan().settings(), evaluator)
                            .of(together, duration == null ? THESIS_SECONDS : duration) / together;
                    out.printf(Locale.ROOT, "  creature %d, %-10s  %7d evaluations of %.3f s: %s%n", creature,
                            scheme.name().toLowerCase(Locale.ROOT), evaluations, each,
                            Pace.readable(Math.round(evaluations * each)));
                    seconds += evaluations * each;
                }
            }
        }
        out.printf("at most %s, with %s%n", Pace.readable(Math.round(seconds)),
                execution.mode() == SimulatorMode.BATCH ? "batches of " + together : together + " at once");
    }
}
