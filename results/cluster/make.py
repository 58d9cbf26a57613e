"""How well clusters of 10 to 10 000 executors would be used: the table of the page and its picture, of efficiency.csv.

--run simulates that with the times of evaluations in times.csv, some ten minutes, and measures these where there are none.

A driver hands parts of generations to executors, event by event: of the size that they have in mode spark, the generations of a run one after
another, the run with the fewest parts under way first, as Spark's FAIR scheduling does. Executors fail, some are slow.
"""
import collections
import heapq
import itertools
import math
import pathlib
import time
from dataclasses import dataclass, field, replace

import numpy as np
import pandas
import study

HERE = pathlib.Path(__file__).parent
EXECUTORS = [10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000]
NEAR = 1.03  # a limit is looked for until a simulated number of executors above it is so many times one below it
REPEATS = 20  # with seeds 1, 2, ...
ENOUGH = 0.8  # below it a cluster is taken to be badly used
# s: the longest part, and that below which none is made shorter, as PartSize.java has them
LONGEST, SHORTEST = 2, 0.05
# as Natator asks Spark to: after which share of a generation, which multiple of the median, how many seconds at least
SPECULATION = 0.9, 3, 10


@dataclass(frozen=True)
class Cluster:
    """What is assumed of it. Times in seconds."""

    per_part: float = 0.003  # of the driver for each part of a generation, one after another: a task of Spark
    per_evaluation: float = 0.0005  # of the driver for each evaluation: request, result and log
    latency: float = 0.01  # from the driver to an executor and back
    per_generation: float = 0.1  # of the driver between two generations: breeding, logs, the checkpoint
    failures_per_hour: float = 0.02  # of an executor; its part is lost with it
    restart: float = 30  # until a failed executor is back
    slow_share: float = 0.02
    slow_factor: float = 3  # how many times as long evaluations take on a slow one
    speculation: bool = True  # what is slow is begun a second time on an idle executor; the first to end counts


CLUSTER = Cluster()
IDEAL = Cluster(0, 0, 0, 0, 0, 0, 0, 1, False)  # nothing takes time but evaluations, and nothing fails
# name: evaluations of a generation, runs at once, generations of each, cluster
LOADS = {
    "one run, 150 gaits": (150, 1, 20, CLUSTER),
    "one run, 150 gaits, if nothing else took time or failed": (150, 1, 20, IDEAL),
    "one run, 150 gaits × 8 starts": (1200, 1, 10, CLUSTER),
    "one run, 150 gaits × 8 starts, slow ones 30 times as slow": (1200, 1, 10, replace(CLUSTER, slow_factor=30)),
    "one run, 150 gaits × 8 starts, 30 times, no second tries": (1200, 1, 10, replace(CLUSTER, slow_factor=30, speculation=False)),
    "32 runs at once, 150 gaits": (150, 32, 10, CLUSTER),
    "32 runs at once, 150 gaits × 8 starts": (1200, 32, 3, CLUSTER),
    "32 runs at once, 150 gaits × 8 starts, a tenth of the driver's time":
        (1200, 32, 3, replace(CLUSTER, per_part=0.1 * CLUSTER.per_part, per_evaluation=0.1 * CLUSTER.per_evaluation)),
}


@dataclass(eq=False, slots=True)
class Executor:
    factor: float
    task: object = None


@dataclass(eq=False, slots=True)
class Part:
    """Evaluations that an executor gets together."""

    run: object
    evaluations: int
    seconds: float
    tasks: list = field(default_factory=list)
    done: bool = False
    watched: bool = False


@dataclass(eq=False, slots=True)
class Task:
    """An attempt at a part."""

    part: Part
    executor: Executor
    begun: float


@dataclass(eq=False, slots=True)
class Run:
    left: int  # generations
    waiting: collections.deque = field(default_factory=collections.deque)
    under_way: dict = field(default_factory=dict)  # a set in the order of insertion
    took: list = field(default_factory=list)
    parts: int = 0


class Simulation:
    """Of a load from its beginning to its end: seconds; efficiency, the share of all executors' time that went into evaluations which counted, at the
    speed of an executor that is not slow; evaluations lost with their executor, and begun a second time."""

    def __init__(self, cluster, evaluations, runs, generations, executors, times, seed):
        self.cluster, self.evaluations, self.times, self.executors = cluster, evaluations, times, executors
        self.random, self.mean = study.Random(seed), math.fsum(times) / len(times)
        self.slots = max(1, executors // runs)
        self.events, self.numbers = [], itertools.count()
        self.now = self.driver_free = self.useful = 0.0
        self.lost = self.copies = 0
        self.idle = collections.deque()
        for _ in range(executors):
            executor = Executor(cluster.slow_factor if self.random.double() < cluster.slow_share else 1)
            self.idle.append(executor)
            self.plan_failure(executor)
        self.runs = [Run(generations) for _ in range(runs)]
        for run in self.runs:
            self.begin_generation(run)
        self.runs_left = runs
        self.dispatch()
        while self.runs_left:
            self.now, _, what, arguments = heapq.heappop(self.events)
            what(*arguments)
            self.dispatch()
        self.seconds, self.efficiency = self.now, self.useful / (executors * self.now)

    def at(self, when, what, *arguments):
        heapq.heappush(self.events, (when, next(self.numbers), what, arguments))

    def begin_generation(self, run):
        run.left -= 1
        run.took = []
        left, first = self.evaluations, 0
        drawn = [self.times[i] for i in self.random.ints(left, len(self.times))]
        while left:
            whole = max(SHORTEST, min(LONGEST, left * self.mean / (2 * self.slots)))
            size = min(left, max(1, int(whole / self.mean)))
            run.waiting.append(Part(run, size, list(itertools.accumulate(drawn[first:first + size]))[-1]))
            left, first = left - size, first + size
        run.parts = len(run.waiting)

    def dispatch(self):
        """Gives idle executors work, as long as there are both."""
        while self.idle:
            run = min((run for run in self.runs if run.waiting), key=lambda run: len(run.under_way), default=None)
            if run is None:
                return
            part = run.waiting.popleft()
            if not part.done:
                self.begin(part)

    def begin(self, part):
        self.driver_free = max(self.driver_free, self.now) + self.cluster.per_part + part.evaluations * self.cluster.per_evaluation
        task = Task(part, self.idle.popleft(), self.driver_free)
        self.copies += part.evaluations if part.tasks else 0
        task.executor.task = task
        part.tasks.append(task)
        part.run.under_way[task] = None
        self.at(self.driver_free + self.cluster.latency + part.seconds * task.executor.factor, self.end, task)

    def end(self, first):
        if first.executor.task is not first:
            return  # it was lost, or another one was faster
        part, run = first.part, first.part.run
        part.done = True
        self.useful += part.seconds
        run.took.append(self.now - first.begun)
        for task in list(part.tasks):
            self.remove(task)
            self.idle.append(task.executor)
        if len(run.took) == run.parts:
            self.driver_free = max(self.driver_free, self.now) + self.cluster.per_generation
            if run.left:
                self.at(self.driver_free, self.begin_generation, run)
            else:
                self.runs_left -= 1
        elif self.cluster.speculation and not run.waiting and len(run.took) >= SPECULATION[0] * run.parts:
            self.watch(run)

    def remove(self, task):
        task.executor.task = None
        task.part.tasks.remove(task)
        del task.part.run.under_way[task]

    def watch(self, run):
        """Plans second tries of what will have been under way for too long."""
        limit = max(SPECULATION[2], SPECULATION[1] * sorted(run.took)[len(run.took) // 2])
        for task in run.under_way:
            if not task.part.watched:
                task.part.watched = True
                self.at(max(self.now, task.begun + limit), self.try_again, task.part)

    def try_again(self, part):
        if not part.done:
            part.run.waiting.append(part)

    def plan_failure(self, executor):
        if self.cluster.failures_per_hour:
            self.at(self.now - math.log(1 - self.random.double()) * 3600 / self.cluster.failures_per_hour, self.fail, executor)

    def fail(self, executor):
        task = executor.task
        if task is None:
            self.idle.remove(executor)
        else:
            self.remove(task)
            self.lost += task.part.evaluations
            task.part.run.waiting.appendleft(task.part)
        self.at(self.now + self.cluster.restart, self.back, executor)

    def back(self, executor):
        self.idle.append(executor)
        self.plan_failure(executor)


def simulated(times):
    """A row for each load and number of executors, also of those near where the efficiency first falls below what is enough: means over the repeats."""
    rows = []
    for name in LOADS:
        own = [row_of(name, executors, times) for executors in EXECUTORS]
        while (between := crossing(own)) and between[1] > max(between[0] + 1, NEAR * between[0]):
            own = sorted([*own, row_of(name, round(math.sqrt(between[0] * between[1])), times)], key=lambda row: row["executors"])
        rows += own
    return pandas.DataFrame(rows)


def row_of(name, executors, times):
    evaluations, runs, generations, cluster = LOADS[name]
    found = [Simulation(cluster, evaluations, runs, generations, executors, times, seed) for seed in range(1, REPEATS + 1)]
    means = {key: float(np.mean([getattr(one, key) for one in found])) for key in ("seconds", "efficiency", "lost", "copies")}
    return {"variant": name, "evaluations": evaluations, "runs_at_once": runs, "generations": generations,
            "seconds_per_part_of_driver": cluster.per_part, "seconds_per_evaluation_of_driver": cluster.per_evaluation,
            "second_tries": str(cluster.speculation).lower(), "executors": executors, "repeats": REPEATS, "seconds": means["seconds"],
            "efficiency": means["efficiency"], "efficiency_sd": float(np.std([one.efficiency for one in found], ddof=1)),
            "lost": means["lost"], "copies": means["copies"]}


def crossing(rows):
    """The largest number of executors whose efficiency is enough before the first that has not, and that one; None if none or all are below."""
    below = next((k for k, row in enumerate(rows) if row["efficiency"] < ENOUGH), 0)
    return (rows[below - 1]["executors"], rows[below]["executors"]) if below else None


def limit(own):
    """Executors up to which the efficiency is enough, as simulated."""
    between = crossing(own.to_dict("records"))
    return f"{between[0]}" if between else f"fewer than {EXECUTORS[0]}" if own.efficiency.iloc[0] < ENOUGH else f"more than {EXECUTORS[-1]}"


def draw(table, file):
    chart = study.Chart("How well a cluster is used", "executors", "share of their time in evaluations that count", size=(11, 7))
    for name, own in table.groupby("variant", sort=False):
        chart.axes.plot(own.executors, own.efficiency, "o-", markersize=4, label=name)
    chart.axes.set(xscale="log", xlim=(10, 10_000), ylim=(0, 1))
    chart.save(file, legend="below")


def make(folder):
    taken, table = pandas.read_csv(HERE / "times.csv"), pandas.read_csv(HERE / "efficiency.csv")
    times, whole = taken.seconds.tolist(), taken[taken.stopped == "completed"].seconds
    known = {name: limit(own) for name, own in table.groupby("variant", sort=False)}
    answer = (f"**By simulation, one run of 150 gaits, nearly all of which end early, uses up to {known['one run, 150 gaits']} executors well, 32 runs with eight starts a gait "
              f"{known['32 runs at once, 150 gaits × 8 starts']}.**\n")
    said = (f"Evaluations take what {len(times)} gaits drawn at random took in `thesis/creature-1`, one after another (`times.csv`): median "
            f"{sorted(times)[len(times) // 2]:.2f} s, from {min(times):.2f} to {max(times):.2f} s; "
            f"{len(whole)} swam to the end and took {whole.median():.2f} s, {(taken.stopped == 'no-progress').sum()} stopped as they made no progress.\n")
    (folder / "README.md").write_text(study.filled(
        HERE / "README.md", answer=answer, times=said, limits="".join(f"- {name}: {value}\n" for name, value in known.items())), encoding="utf-8")
    draw(table, folder / "efficiency.png")


def run():
    if not (HERE / "times.csv").exists():
        measure()
    simulated(pandas.read_csv(HERE / "times.csv").seconds.tolist()).to_csv(HERE / "efficiency.csv", index=False)


def measure(scene="thesis/creature-1", count=150):
    """Measures how long gaits drawn at random take one after another; the first starts the program and settles the scene."""
    import natator
    random, rows = np.random.default_rng(1), []
    with natator.Stream(scene) as stream:
        n = stream.actuators
    with natator.Simulator(workers=1) as simulator:
        for number in range(count + 1):
            gait = natator.Gait(random.uniform(0.5, 2), random.uniform(size=n), [0, *random.uniform(size=n - 1)])
            start = time.perf_counter()
            result = simulator.evaluate(scene, gait)
            rows.append({"evaluation": number, "seconds": time.perf_counter() - start, "stopped": result["stopped"]})
    pandas.DataFrame(rows[1:]).to_csv(HERE / "times.csv", index=False)


if __name__ == "__main__":
    study.main(make, run)
