"""The page's answer, tables and pictures: what policies that were learned, and gaits beside them, swim from starts that learning never drew."""
import csv
import gzip
import json
import pathlib
import statistics

import numpy as np
from scipy import stats
import study

HERE = pathlib.Path(__file__).parent
LEVELS = {"scene": {}, "step": {"solver": {"substeps": 48}}}
STARTS, SEEDS = range(1000, 1016), range(500, 516)
REST, STRAIGHT = [-1.0] * 5 + [0.0] * 5, [1.0] * 5 + [0.0] * 5
BENDS = (0.1, 0.2, 0.4)  # largest actions of the rule that steers
HEAD = ["task", "swimmer", "level", "start", "return", "time", "reached", "unstable", "away"]
NAMES = {"turn-1": "learned", "steered-0.1": "evolved gait, steered by at most 0.05", "steered-0.2": "by at most 0.1",
         "steered-0.4": "by at most 0.2", "station-1": "learned", "rest": "resting body", "evolved": "evolved gait", "ahead-1": "learned"}


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
    return [(f"{task}-1", Policy(HERE / f"{task}-1/policy.json"), None)] + [(name, evolved, act) for name, act in gaits]


def run():
    """Swims what the rows lack: of all on a core of a server 20 minutes."""
    done = [list(row.values()) for row in rows("swims.csv")] if (HERE / "swims.csv").exists() else []
    paths = [list(row.values()) for row in rows("paths.csv.gz")] if (HERE / "paths.csv.gz").exists() else []
    for level, overrides in LEVELS.items():
        for task in ("turn", "station", "ahead"):
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


def interval(values):
    """Mean and half the interval of 95 %, of Student's t."""
    return statistics.fmean(values), stats.t.ppf(0.975, len(values) - 1) * statistics.stdev(values) / len(values) ** 0.5


def cell(values):
    return "" if len(values) < 2 else study.with_error(*interval(values), 2)


def curves(folder):
    figure, axes = study.pyplot.subplots(figsize=(7, 3.2))
    for task in ("turn", "station", "ahead"):
        seconds, episodes, means = (np.array([float(row[key]) for row in rows(f"{task}-1/curve.csv")]) for key in ("seconds", "episodes", "mean_return"))
        bins = (seconds - seconds[0]) // 8
        axes.plot([8 * (one + 0.5) for one in np.unique(bins)],
                  [np.average(means[bins == one], weights=episodes[bins == one]) for one in np.unique(bins)], marker=".", label=task)
    axes.set(xlabel="time since the first episode ended, s", ylabel="mean return, body lengths")
    axes.legend()
    finish(figure, folder / "curve.png")


def paths(folder):
    figure, all_axes = study.pyplot.subplots(1, 3, figsize=(9, 3.3), width_ratios=[1.2, 1.6, 1.6])
    box = {task: json.loads((HERE / f"{task}-1/policy.json").read_text(encoding="utf-8"))["environment"]["target"] for task in ("turn", "station")}
    places = rows("paths.csv.gz")
    for axes, (task, name, title) in zip(all_axes, (("turn", "turn-1", "learned turns"), ("station", "station-1", "learned stations"),
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

    def told(task):
        return list(dict.fromkeys(row["swimmer"] for row in swum if row["task"] == task))

    turn = study.table(["to a target", "reached, of 16", "s, those", "at half the time step", "s, those"], [
        [NAMES[name], *(text for level in LEVELS for text in (
            str(there(name, level)), cell(of("turn", name, level, "time", lambda row: float(row["reached"])))))] for name in told("turn")])
    station = study.table(["in a current of 0.4", "body lengths away", "at half the time step"], [
        [NAMES[name], *(cell(of("station", name, level, "away")) for level in LEVELS)] for name in told("station")])
    ahead = study.table(["ahead", "body lengths/s", "at half the time step"], [
        [NAMES[name], *(cell([one / 4 for one in of("ahead", name, level, "return")]) for level in LEVELS)] for name in told("ahead")])
    trainings = study.table(["task", "steps of 0.1 s", "s", "steps/s"], [
        [row["task"], row["steps"], row["seconds"], f"{int(row['steps']) / int(row['seconds']):.0f}"] for row in rows("trainings.csv")])
    def both(task, name, key, part=1):
        """A mean, and that at half the time step."""
        return "{:.2f} ({:.2f} at half the time step)".format(*(statistics.fmean(of(task, name, level, key)) / part for level in LEVELS))
    rest, gait = statistics.fmean(of("station", "rest", "scene", "away")), statistics.fmean(of("ahead", "evolved", "scene", "return")) / 4
    answer = (f"**In about a minute PPO learns to reach {there('turn-1', 'scene')} of 16 targets ({there('turn-1', 'step')} at half the time step) and to "
              f"stay on average {both('station', 'station-1', 'away')} body lengths from a station in a current, where a resting body is {rest:.2f} away; "
              f"but a rule that bends the evolved gait reaches {there('steered-0.4', 'scene')}, and ahead that gait makes {gait:.2f} body "
              f"lengths/s, what is learned {both('ahead', 'ahead-1', 'return', 4)}.**\n")
    curves(folder)
    paths(folder)
    page = study.filled(HERE / "README.md", answer=answer, turn=turn, station=station, ahead=ahead, trainings=trainings)
    (folder / "README.md").write_text(page, encoding="utf-8")


study.main(make, run)
