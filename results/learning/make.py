"""The page's answer, tables and pictures: what policies that were learned, and gaits beside them, swim from starts that learning never drew."""
import csv
import gzip
import json
import pathlib
import statistics

import numpy as np
import study

HERE = pathlib.Path(__file__).parent
HALF_CELLS = {"count": [320, 1, 160], "spacing": 0.01, "origin": [0.005, 0.01, 0.005], "mass": {"bottom": 0.25}}
LEVELS = {"scene": {}, "step": {"solver": {"substeps": 48}}, "cells": {"solver": {"substeps": 48}, "fluid": HALF_CELLS}}
LEARNED = (1, 2, 3)  # seeds
STARTS, SEEDS = range(1000, 1016), range(500, 516)
REST, STRAIGHT = [-1.0] * 5 + [0.0] * 5, [1.0] * 5 + [0.0] * 5
TASKS = ("turn", "station", "ahead")
BENDS = (0.1, 0.2, 0.4)  # largest actions of the rule that steers
HEAD = ["task", "swimmer", "level", "start", "return", "time", "reached", "unstable", "away"]
NAMES = {"steered-0.2": "evolved gait, steered by at most 0.1",
         "steered-0.4": "by at most 0.2", "rest": "resting body", "evolved": "evolved gait",
         **{f"{task}-{seed}": f"learned, seed {seed}" for task in TASKS for seed in LEARNED}}


def rows(name):
    file = HERE / name
    with gzip.open(file, "rt", newline="") if file.suffix == ".gz" else open(file, encoding="utf-8", newline="") as opened:
        return list(csv.DictReader(opened))


def steered(largest):
    """The gait, bent by an offset in proportion to the angle of the target."""
    def act(observations):
        actions, (ahead, right) = np.tile(STRAIGHT, (len(observations), 1)), observations[:, [-4, -2]].T
        actions[:, 5:] = np.clip(-np.arctan2(right, ahead) / (np.pi / 2), -1, 1)[:, None] * largest
        return actions
    return act


def constant(action):
    return lambda observations: np.tile(action, (len(observations), 1))


def swimmers(task):
    """Of each its name, a Policy with the environment, and what acts in place of it."""
    from natator.policy import Policy
    evolved = Policy(HERE / f"{task}-1/policy.json")
    evolved.environment["gait"] = json.loads((HERE / "../schools/gait.json").read_text(encoding="utf-8"))
    gaits = {"turn": [(f"steered-{largest}", steered(largest)) for largest in BENDS],
             "station": [("rest", constant(REST)), ("evolved", constant(STRAIGHT))], "ahead": [("evolved", constant(STRAIGHT))]}[task]
    return [(f"{task}-{seed}", Policy(HERE / f"{task}-{seed}/policy.json"), None) for seed in LEARNED] + [(name, evolved, act) for name, act in gaits]


def run():
    """Swims what the rows lack: of all on two cores of a server half an hour."""
    done = [list(row.values()) for row in rows("swims.csv")] if (HERE / "swims.csv").exists() else []
    paths = [list(row.values()) for row in rows("paths.csv.gz")] if (HERE / "paths.csv.gz").exists() else []
    for level, overrides in LEVELS.items():
        for task in TASKS:
            for name, policy, act in swimmers(task):
                if any(row[:3] == [task, name, level] for row in done):
                    continue
                told = policy.swims(STARTS, SEEDS, overrides, act=act)
                away = told.get("away", np.zeros(len(STARTS)))
                done += [[task, name, level, start, *(f"{value:.4g}" for value in row)] for start, *row in zip(
                    STARTS, told["return"], told["time"], told["reached"], told["unstable"], away)]
                if level == "scene" and task != "ahead":
                    paths += [[task, name, start, step, f"{at[0]:.3f}", f"{at[2]:.3f}"] for start, own in zip(STARTS, told["centre"])
                              for step, at in enumerate(own) if np.isfinite(at[0])]
                with open(HERE / "swims.csv", "w", encoding="utf-8", newline="") as file:
                    csv.writer(file, lineterminator="\n").writerows([HEAD, *done])
                text = "".join(",".join(map(str, row)) + "\n" for row in [["task", "swimmer", "start", "step", "x", "z"], *paths])
                (HERE / "paths.csv.gz").write_bytes(gzip.compress(text.encode(), mtime=0))


def cell(values):
    return "" if len(values) < 2 else study.with_error(*study.interval(values), 2)


def curves(folder):
    figure, axes = study.pyplot.subplots(figsize=(7, 3.2))
    for colour, task in enumerate(TASKS):
        for seed in LEARNED:
            seconds, episodes, means = (np.array([float(row[key]) for row in rows(f"{task}-{seed}/curve.csv")]) for key in ("seconds", "episodes", "mean_return"))
            bins = seconds // 8
            axes.plot([8 * (one + 0.5) for one in np.unique(bins)],
                      [np.average(means[bins == one], weights=episodes[bins == one]) for one in np.unique(bins)],
                      marker=".", color=f"C{colour}", label=task if seed == LEARNED[0] else None)
    axes.set(xlabel="s", ylabel="mean return, body lengths")
    axes.legend()
    finish(figure, folder / "curve.png")


def paths(folder):
    figure, all_axes = study.pyplot.subplots(1, 3, figsize=(9, 3.3), width_ratios=[1.2, 1.6, 1.6])
    box = {task: json.loads((HERE / f"{task}-1/policy.json").read_text(encoding="utf-8"))["environment"]["target"] for task in ("turn", "station")}
    places = rows("paths.csv.gz")
    for axes, (task, name, title) in zip(all_axes, (("turn", "turn-1", "turns, seed 1"), ("station", "station-1", "stations, seed 1"),
                                                    ("station", "rest", "resting in the current"))):
        for number, (start, seed) in enumerate(zip(STARTS, SEEDS)):
            own = [row for row in places if (row["task"], row["swimmer"], int(row["start"])) == (task, name, start)]
            target, colour = np.random.default_rng(seed).uniform(*box[task]), f"C{number % 10}"
            axes.plot([float(row["x"]) for row in own], [float(row["z"]) for row in own], lw=1, color=colour)
            axes.plot(target[0], target[2], "x", ms=5, color=colour)
        axes.set(title=title, xlabel="x", aspect="equal")
        axes.invert_yaxis()
    for axes in all_axes[1:]:
        axes.set(xlim=(0.6, 3.3), ylim=(2.3, -0.7))
    all_axes[0].set(xlim=(2, 4.3), ylim=(3, -1.4))
    all_axes[0].set_ylabel("z")
    finish(figure, folder / "paths.png")


def finish(figure, file):
    for axes in figure.axes:
        axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(file, dpi=100, metadata={"Software": None})
    study.pyplot.close(figure)


def make(folder):
    swum = rows("swims.csv")

    def of(task, name, level, key, only=lambda row: True):
        return [float(row[key]) for row in swum if (row["task"], row["swimmer"], row["level"]) == (task, name, level) and only(row)]

    def there(name, level):
        return int(sum(of("turn", name, level, "reached")))

    def table(task, first, cell_of):
        told = dict.fromkeys(row["swimmer"] for row in sorted(swum, key=lambda row: not row["swimmer"].startswith(task))
                             if row["task"] == task and row["swimmer"] in NAMES)
        return study.table([first[0], first[1], "at half the time step", "and in half the cells"],
                           [[NAMES[name], *(cell_of(name, level) for level in LEVELS)] for name in told])

    def ends(value, names):
        """The least and the greatest, at all levels."""
        values = sorted(value(name, level) for name in names for level in LEVELS)
        return " to ".join(dict.fromkeys(f"{one:.3g}" for one in (values[0], values[-1])))

    def learned(task, value):
        return ends(value, [f"{task}-{seed}" for seed in LEARNED])

    def mean(task, key, part=1):
        return lambda name, level: round(statistics.fmean(of(task, name, level, key)) / part, 2)

    def seconds(name, level):
        return cell(of("turn", name, level, "time", lambda row: float(row["reached"])))
    turn = table("turn", ("to a target", "reached, of 16; s, those"),
                 lambda name, level: f"{there(name, level)}; {seconds(name, level)}" if level == "scene" else str(there(name, level)))
    station = table("station", ("in a current of 0.4", "body lengths away"), lambda name, level: cell(of("station", name, level, "away")))
    ahead = table("ahead", ("ahead", "body lengths/s"), lambda name, level: cell([one / 4 for one in of("ahead", name, level, "return")]))
    trained = rows("trainings.csv")
    speeds = sorted(int(row["steps"]) / int(row["seconds"]) for row in trained)
    trainings = f"Of {speeds[0]:.0f} to {speeds[-1]:.0f} steps/s each (0.1 s), learning included,\n"
    forward, away = mean("ahead", "return", 4), mean("station", "away")
    better, more = (sum(any(one(f"{task}-{seed}", level) > one(rival, level) for level in LEVELS) for seed in LEARNED)
                    for task, one, rival in (("ahead", forward, "evolved"), ("turn", there, "steered-0.4")))
    answer = (f"**Ahead {better or 'none'} of {len(LEARNED)} seeds does better, in turns {more or 'none'} reaches more targets than the best rule: in {max(int(row['seconds']) for row in trained) / 60:.1f} minutes PPO learns policies that, tried also at half the time step and in cells of half the size at that, swim ahead at "
              f"{learned('ahead', forward)} body lengths/s (the evolved gait: {ends(forward, ['evolved'])}), reach {learned('turn', there)} of 16 targets (a rule that bends "
              f"that gait, its limit chosen: {ends(there, ['steered-0.4'])}), and stay {learned('station', away)} body lengths from a station in a current (a resting body: "
              f"{ends(away, ['rest'])}).**\n")
    curves(folder)
    paths(folder)
    page = study.filled(HERE / "README.md", answer=answer, turn=turn, station=station, ahead=ahead, trainings=trainings)
    (folder / "README.md").write_text(page, encoding="utf-8")


study.main(make, run)
