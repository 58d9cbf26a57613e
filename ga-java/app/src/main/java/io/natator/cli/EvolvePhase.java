package io.natator.cli;

import io.natator.checkpoint.CompactRun;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Numbers;
import io.natator.run.RunQueue;
import io.natator.simulator.Evaluator;
import io.natator.study.thesis.EvolutionPlan;
import io.natator.study.thesis.EvolvedRun;
import io.natator.study.thesis.Finalists;
import io.natator.study.thesis.Water;
import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;

/** The evolutions of {@code reproduce}: carries them out, or says how long they will take. */
final class EvolvePhase {

    private static final double THESIS_SECONDS = 4;

    private final EvolutionPlan plan;
    private final ExecutionSettings execution;

    EvolvePhase(EvolutionPlan plan, ExecutionSettings execution) {
        this.plan = plan;
        this.execution = execution;
    }

    /**
     * Evolves what is not finished.
     *
     * @param queue   how many runs at once, and when to stop
     * @param compact whether finished evolutions are made small
     * @return whether all are finished
     */
    boolean run(QueueOptions queue, boolean compact, PrintWriter err) throws InterruptedException {
        queue.atOnce(execution);  // refused, as changed scenes are, before anything is made small
        RunQueue runs = new RunQueue(plan.runs().stream().map(EvolvedRun::plan).toList(), execution.simulator());
        long recorded = plan.runs().stream().filter(run -> !run.plan().isFinished())
                .mapToLong(run -> run.plan().recorded()).sum();
        try {
            return queue.carryOut(runs::run, execution, plan.runs().size(), plan.finished().size(),
                    recorded + left(plan.runs()), recorded, err);
        } finally {
            plan.finished().forEach(run -> Finalists.keep(run.plan().directory()));
            if (compact) {
                plan.finished().forEach(run -> CompactRun.compact(run.plan().directory()));
            }
        }
    }

    /** Evaluations that are still to be done, as far as can be known. */
    private static long left(List<EvolvedRun> runs) {
        return runs.stream().filter(run -> !run.plan().isFinished())
                .mapToLong(run -> Math.max(0, ProgressEstimate.evaluations(run.plan().settings()) - run.plan().recorded())).sum();
    }

    /** Says how many evaluations are left and how long they will take, judged by a few short ones. */
    void forecast(PrintWriter out) throws InterruptedException {
        out.printf("%s, %d of them finished; about %d evaluations left%n", Numbers.count(plan.runs().size(), "evolution"),
                plan.finished().size(), left(plan.runs()));
        int together = execution.trials(plan.runs().get(0).plan().settings().population());
        double seconds = 0;
        try (Evaluator evaluator = Evaluator.open(execution)) {
            for (int creature : plan.runs().stream().map(EvolvedRun::creature).distinct().toList()) {
                for (Water water : Water.values()) {
                    List<EvolvedRun> cell = plan.runs().stream()
                            .filter(run -> run.creature() == creature && run.water() == water).toList();
                    if (cell.isEmpty()) {
                        continue;
                    }
                    Double duration = cell.get(0).plan().settings().duration();
                    long evaluations = left(cell);
                    double each = new EvaluationTime(cell.get(0).plan().settings(), evaluator)
                            .of(together, duration == null ? THESIS_SECONDS : duration) / together;
                    out.printf(Locale.ROOT, "  creature %d, %-10s  %7d evaluations of %.3f s: %s%n", creature,
                            water.label(), evaluations, each,
                            ProgressEstimate.readable(Math.round(evaluations * each)));
                    seconds += evaluations * each;
                }
            }
        }
        out.printf("about %s, with %s%n", ProgressEstimate.readable(Math.round(seconds)),
                execution.inBatches() ? "batches of " + together : together + " at once");
    }
}
