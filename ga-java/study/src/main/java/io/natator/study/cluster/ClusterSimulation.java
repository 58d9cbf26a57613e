package io.natator.study.cluster;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.Deque;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.PriorityQueue;
import java.util.Random;
import java.util.Set;

/**
 * A driver that hands evaluations to executors, event by event: one evaluation a task, the generations of a run one after
 * another, the run with the fewest tasks under way first, as Spark's FAIR scheduling does. The same seed gives the same
 * outcome.
 */
public final class ClusterSimulation {

    private static final double HOUR = 3600;
    /** As Natator asks Spark to: after which share of a generation, which multiple of the median, how many seconds at least. */
    private static final double SPECULATION_SHARE = 0.9;
    private static final double SPECULATION_MULTIPLE = 3;
    private static final double SPECULATION_SECONDS = 10;

    private final Assumptions cluster;
    private final Load load;
    private final double[] times;
    private final int executors;
    private final Random random;
    private final PriorityQueue<Event> events =
            new PriorityQueue<>(Comparator.comparingDouble(Event::time).thenComparingLong(Event::number));
    private final Deque<Executor> idle = new ArrayDeque<>();
    private final List<Run> runs = new ArrayList<>();

    private long planned;
    private double now;
    private double driverFree;
    private int runsLeft;
    private double useful;
    private long lost;
    private long copies;

    private record Event(double time, long number, Runnable what) {
    }

    private static final class Executor {
        private final double factor;
        private Task task;

        private Executor(double factor) {
            this.factor = factor;
        }
    }

    private static final class Evaluation {
        private final Run run;
        private final double seconds;
        private final List<Task> tasks = new ArrayList<>();
        private boolean done;
        private boolean watched;

        private Evaluation(Run run, double seconds) {
            this.run = run;
            this.seconds = seconds;
        }
    }

    /** An attempt at an evaluation. */
    private static final class Task {
        private final Evaluation evaluation;
        private final Executor executor;
        private final double begun;

        private Task(Evaluation evaluation, Executor executor, double begun) {
            this.evaluation = evaluation;
            this.executor = executor;
            this.begun = begun;
        }
    }

    private static final class Run {
        private final Deque<Evaluation> waiting = new ArrayDeque<>();
        private final Set<Task> underWay = new LinkedHashSet<>();
        private int generationsLeft;
        private double[] took;
        private int done;
    }

    private ClusterSimulation(Assumptions cluster, Load load, int executors, double[] times, long seed) {
        this.cluster = cluster;
        this.load = load;
        this.executors = executors;
        this.times = times;
        this.random = new Random(seed);
    }

    /**
     * Simulates the load to its end.
     *
     * @param times that evaluations take, s, from which they are drawn; at least one
     */
    public static Usage run(Assumptions cluster, Load load, int executors, double[] times, long seed) {
        return new ClusterSimulation(cluster, load, executors, times, seed).run();
    }

    private Usage run() {
        for (int i = 0; i < executors; i++) {
            Executor executor = new Executor(i < Math.round(cluster.slowShare() * executors) ? cluster.slowFactor() : 1);
            idle.add(executor);
            planFailure(executor);
        }
        for (int i = 0; i < load.runsAtOnce(); i++) {
            Run run = new Run();
            run.generationsLeft = load.generations();
            runs.add(run);
            beginGeneration(run);
        }
        runsLeft = runs.size();
        for (dispatch(); runsLeft > 0; dispatch()) {
            Event next = events.remove();
            now = next.time;
            next.what.run();
        }
        return new Usage(now, useful / (executors * now), lost, copies);
    }

    private void at(double time, Runnable what) {
        events.add(new Event(time, planned++, what));
    }

    private void beginGeneration(Run run) {
        run.generationsLeft--;
        run.done = 0;
        run.took = new double[load.evaluations()];
        for (int i = 0; i < load.evaluations(); i++) {
            run.waiting.add(new Evaluation(run, times[random.nextInt(times.length)]));
        }
    }

    /** Gives idle executors work, as long as there are both. */
    private void dispatch() {
        while (!idle.isEmpty()) {
            Run run = runs.stream().filter(each -> !each.waiting.isEmpty())
                    .min(Comparator.comparingInt(each -> each.underWay.size())).orElse(null);
            if (run == null) {
                return;
            }
            Evaluation next = run.waiting.remove();
            if (!next.done) {
                begin(next);
            }
        }
    }

    private void begin(Evaluation evaluation) {
        driverFree = Math.max(driverFree, now) + cluster.perEvaluation();
        Task task = new Task(evaluation, idle.remove(), driverFree);
        copies += evaluation.tasks.isEmpty() ? 0 : 1;
        task.executor.task = task;
        evaluation.tasks.add(task);
        evaluation.run.underWay.add(task);
        at(driverFree + cluster.latency() + evaluation.seconds * task.executor.factor, () -> {
            if (task.executor.task == task) {
                end(evaluation, task);
            }
        });
    }

    private void end(Evaluation evaluation, Task first) {
        Run run = evaluation.run;
        evaluation.done = true;
        useful += evaluation.seconds;
        run.took[run.done++] = now - first.begun;
        for (Task task : List.copyOf(evaluation.tasks)) {
            remove(task);
            idle.add(task.executor);
        }
        if (run.done == load.evaluations()) {
            endGeneration(run);
        } else if (cluster.speculation() && run.waiting.isEmpty() && run.done >= SPECULATION_SHARE * load.evaluations()) {
            watch(run);
        }
    }

    private void endGeneration(Run run) {
        driverFree = Math.max(driverFree, now) + cluster.perGeneration();
        if (run.generationsLeft > 0) {
            at(driverFree, () -> beginGeneration(run));
        } else {
            runsLeft--;
        }
    }

    private void remove(Task task) {
        task.executor.task = null;
        task.evaluation.tasks.remove(task);
        task.evaluation.run.underWay.remove(task);
    }

    /** Plans second tries of what will have been under way for too long. */
    private void watch(Run run) {
        double median = Arrays.stream(run.took, 0, run.done).sorted().skip(run.done / 2).findFirst().orElseThrow();
        double limit = Math.max(SPECULATION_SECONDS, SPECULATION_MULTIPLE * median);
        for (Task task : run.underWay) {
            Evaluation evaluation = task.evaluation;
            if (!evaluation.watched) {
                evaluation.watched = true;
                at(Math.max(now, task.begun + limit), () -> {
                    if (!evaluation.done) {
                        run.waiting.add(evaluation);
                    }
                });
            }
        }
    }

    private void planFailure(Executor executor) {
        if (cluster.failuresPerHour() > 0) {
            at(now - Math.log(1 - random.nextDouble()) * HOUR / cluster.failuresPerHour(), () -> fail(executor));
        }
    }

    private void fail(Executor executor) {
        Task task = executor.task;
        if (task == null) {
            idle.remove(executor);
        } else {
            remove(task);
            lost++;
            task.evaluation.run.waiting.addFirst(task.evaluation);
        }
        at(now + cluster.restart(), () -> {
            idle.add(executor);
            planFailure(executor);
        });
    }
}
