package io.natator.study.cluster;

import io.natator.simulator.PartSize;
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
 * A driver that hands parts of generations to executors, event by event: of the {@link PartSize size} that they have in mode
 * spark, the generations of a run one after another, the run with the fewest parts under way first, as Spark's FAIR scheduling
 * does. The same seed gives the same outcome.
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
    private final double mean;
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

    /** Evaluations that an executor gets together. */
    private static final class Part {
        private final Run run;
        private final int evaluations;
        private final double seconds;
        private final List<Task> tasks = new ArrayList<>();
        private boolean done;
        private boolean watched;

        private Part(Run run, int evaluations, double seconds) {
            this.run = run;
            this.evaluations = evaluations;
            this.seconds = seconds;
        }
    }

    /** An attempt at a part. */
    private static final class Task {
        private final Part part;
        private final Executor executor;
        private final double begun;

        private Task(Part part, Executor executor, double begun) {
            this.part = part;
            this.executor = executor;
            this.begun = begun;
        }
    }

    private static final class Run {
        private final Deque<Part> waiting = new ArrayDeque<>();
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
        this.mean = Arrays.stream(times).average().orElseThrow();
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
        int slots = Math.max(1, executors / load.runsAtOnce());
        for (int left = load.evaluations(); left > 0;) {
            int size = Math.min(left, PartSize.of(left * mean, mean, slots));
            double seconds = 0;
            for (int i = 0; i < size; i++) {
                seconds += times[random.nextInt(times.length)];
            }
            run.waiting.add(new Part(run, size, seconds));
            left -= size;
        }
        run.took = new double[run.waiting.size()];
    }

    /** Gives idle executors work, as long as there are both. */
    private void dispatch() {
        while (!idle.isEmpty()) {
            Run run = runs.stream().filter(each -> !each.waiting.isEmpty())
                    .min(Comparator.comparingInt(each -> each.underWay.size())).orElse(null);
            if (run == null) {
                return;
            }
            Part next = run.waiting.remove();
            if (!next.done) {
                begin(next);
            }
        }
    }

    private void begin(Part part) {
        driverFree = Math.max(driverFree, now) + cluster.perPart() + part.evaluations * cluster.perEvaluation();
        Task task = new Task(part, idle.remove(), driverFree);
        copies += part.tasks.isEmpty() ? 0 : part.evaluations;
        task.executor.task = task;
        part.tasks.add(task);
        part.run.underWay.add(task);
        at(driverFree + cluster.latency() + part.seconds * task.executor.factor, () -> {
            if (task.executor.task == task) {
                end(part, task);
            }
        });
    }

    private void end(Part part, Task first) {
        Run run = part.run;
        part.done = true;
        useful += part.seconds;
        run.took[run.done++] = now - first.begun;
        for (Task task : List.copyOf(part.tasks)) {
            remove(task);
            idle.add(task.executor);
        }
        if (run.done == run.took.length) {
            endGeneration(run);
        } else if (cluster.speculation() && run.waiting.isEmpty() && run.done >= SPECULATION_SHARE * run.took.length) {
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
        task.part.tasks.remove(task);
        task.part.run.underWay.remove(task);
    }

    /** Plans second tries of what will have been under way for too long. */
    private void watch(Run run) {
        double median = Arrays.stream(run.took, 0, run.done).sorted().skip(run.done / 2).findFirst().orElseThrow();
        double limit = Math.max(SPECULATION_SECONDS, SPECULATION_MULTIPLE * median);
        for (Task task : run.underWay) {
            Part part = task.part;
            if (!part.watched) {
                part.watched = true;
                at(Math.max(now, task.begun + limit), () -> {
                    if (!part.done) {
                        run.waiting.add(part);
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
            lost += task.part.evaluations;
            task.part.run.waiting.addFirst(task.part);
        }
        at(now + cluster.restart(), () -> {
            idle.add(executor);
            planFailure(executor);
        });
    }
}
