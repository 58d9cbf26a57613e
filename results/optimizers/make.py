"""Compares optimizers at an equal number of evaluations: a page, its tables and pictures, of SCENE.jsonl, -again.jsonl and -ranks.jsonl.

FOLDER/study.json says what is compared. --run evolves by `natator evolve` in FOLDER/runs/SCENE/OPTIMIZER/seed-S, runs the best gaits again by
`natator compare`, and keeps a line of each run; a run that was stopped goes on.
"""
import itertools
import json
import os
import pathlib
import subprocess
import tempfile

import numpy as np
import pandas
import study
from scipy import stats

SHARES = [0.1, 0.25, 0.5, 1]
COLOURS = ["#1f77b4", "#2ca02c", "#7f7f7f", "#ff7f0e", "#d62728", "#9467bd"]
# what is equal: what a run has spent at its end, and at one of its improvements; how that is told
BUDGETS = {
    "evaluations": (lambda run: run["evaluations"], lambda step: step["evaluation"] + 1, lambda place: f"{place:.0f}"),
    "simulated time": (lambda run: (run.get("statistics") or {}).get("simulatedSeconds", np.nan), lambda step: step.get("simulated"),
                       lambda place: study.fixed(place, 1 if place < 100 else 0) + " s"),
}
TOLD = "evaluations"  # the budget that the page tells of; fresh.csv and tests.csv have both
JUDGES = {"mean": np.mean, "median": np.median, "lower-quartile": lambda runs: np.quantile(runs, 0.25)}


def lines(file):
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.exists() else []


class Scene:
    """The finished runs on one scene, with what their gaits do from fresh starts."""

    def __init__(self, folder, name, optimizers):
        self.name = name
        self.runs = sorted(lines(folder / f"{name}.jsonl"), key=lambda run: (run["settings"]["seed"], optimizers.index(run["optimizer"])))
        for run in self.runs:
            run["evaluations"] = sum(one["evaluations"] for one in run["generations"])
        self.judge = JUDGES[self.runs[0]["settings"].get("judge", "mean")]
        self.again = {(row["optimizer"], row["seed"], tuple(row["genes"])): row["runs"] for row in lines(folder / f"{name}-again.jsonl")}
        self.ranks = {(row["optimizer"], row["seed"]): row["spearman"] for row in lines(folder / f"{name}-ranks.jsonl")}
        self.own = {name: [run for run in self.runs if run["optimizer"] == name] for name in optimizers}
        self.own = {name: runs for name, runs in self.own.items() if runs}

    def place(self, budget, share):
        """A share of what all runs have spent at least."""
        least = min(BUDGETS[budget][0](run) for run in self.runs)
        return max(1, round(share * least)) if budget == "evaluations" else share * least

    def worths(self, runs, budget, place):
        """What each run's best gait at a place is worth from fresh starts, as far as it is known."""
        found = [self.worth(run, leader(run, budget, place)) for run in runs]
        return [worth for worth in found if worth is not None]

    def worth(self, run, genes):
        if genes is None:
            return None
        if "fresh" in run["best"] and genes == run["best"]["genes"]:
            return run["best"]["fresh"]["again"]
        runs = self.again.get((run["optimizer"], run["settings"]["seed"], tuple(genes)))
        return None if runs is None else float(self.judge(runs))

    def loss(self, run):
        """The share of what a winner was chosen for that it lacks from fresh starts; None where that tells nothing."""
        best = run["best"] or {}
        if "fresh" in best:
            return best["fresh"].get("selectionLoss")
        runs = self.again.get((run["optimizer"], run["settings"]["seed"], tuple(best.get("genes", ()))))
        if runs is None or curve(run)[-1] <= np.std(runs, ddof=1) / len(runs)**0.5:
            return None
        return 1 - float(self.judge(runs)) / curve(run)[-1]


def leader(run, budget, place):
    """The genes that a run would have taken for its winner, had it ended earlier; None if that is not known."""
    whole, spent, _ = BUDGETS[budget]
    if place >= whole(run):
        return (run["best"] or {}).get("genes")
    genes = None
    for step in run["improvements"]:
        if spent(step) is None or spent(step) > place:
            break
        genes = step.get("genes", genes)
    return genes


def curve(run):
    """Best fitness after each evaluation, the last by what the winner was chosen for."""
    values = np.zeros(run["evaluations"])
    for step in run["improvements"]:
        values[step["evaluation"]:] = step["fitness"]
    if run["best"] and "selected" in run["best"]:
        values[-1] = run["best"]["selected"]
    return values


def frame(scene):
    """A row for each optimizer and share of the evaluations: best fitness so far."""
    rows = []
    for name, runs in scene.own.items():
        curves = np.array([curve(run) for run in runs])
        for place in (max(1, round(share * curves.shape[1])) for share in SHARES):
            at = curves[:, place - 1]
            least, lower, median, upper, greatest = np.quantile(at, [0, 0.25, 0.5, 0.75, 1])
            rows.append({"scene": scene.name, "optimizer": name, "population": runs[0]["settings"]["population"], "runs": len(runs),
                         "evaluations": place, "lower_quartile": lower, "median": median, "upper_quartile": upper, "mean": at.mean(),
                         "sd": at.std(ddof=1) if len(at) > 1 else np.nan, "least": least, "greatest": greatest})
    return pandas.DataFrame(rows)


def medians(scene):
    return pandas.DataFrame([
        dict(zip(["scene", "equal", "place", "optimizer", "runs", "median", "low", "high"],
                 [scene.name, budget, float(place), name, len(worths), *study.median_interval(worths)], strict=True))
        for budget in BUDGETS for place in (scene.place(budget, share) for share in SHARES) for name, runs in scene.own.items()
        if (worths := scene.worths(runs, budget, place))])


def tests(scene):
    rows = [{"scene": scene.name, "equal": budget, "place": float(scene.place(budget, 1))} | pair for budget in BUDGETS
            for pair in study.pairs({name: scene.worths(runs, budget, scene.place(budget, 1)) for name, runs in scene.own.items()})]
    return pandas.DataFrame(rows, columns=["scene", "equal", "place", "first", "second", "difference", "low", "high", "p", "p_holm", "a",
                                           "cliffs_delta", "verdict"])


def again_table(found):
    own = found[found.equal == TOLD]
    places = [BUDGETS[TOLD][2](place) for place in own.place.unique()]
    rows = [[name, str(rows.runs.iloc[-1]), *(study.interval_text((row.median, row.low, row.high), 4) for row in rows.itertuples())]
            for name, rows in own.groupby("optimizer", sort=False)]
    return study.table(["optimizer", "runs", *(f"after {place}" for place in places)], rows)


def tests_table(found):
    rows = [[row.first, row.second, study.interval_text((row.difference, row.low, row.high), 4), study.chance(row.p_holm).removeprefix("= "),
             study.fixed(row.a, 2)] for row in found[found.equal == TOLD].itertuples(name="Pair")]
    return study.table(["first", "second", "difference of medians", "p", "A"], rows, "<<>>>") if rows else "nothing to compare\n"


def measure(scene):
    """In words, where the fitness is not the distance alone."""
    return ", by distance less the work's price," if len(scene.runs[0]["settings"].get("objectives") or []) > 1 else ""


def at_half_step(scene):
    """In words by which pairs of optimizers the winners' distances, by fresh starts at half the time step, surely differ. Where many of these swims
    end early, what they went is no measure."""
    by = "by distance alone " if measure(scene) else ""
    fresh = [run["best"]["fresh"]["halfStep"] for runs in scene.own.values() for run in runs]
    whole, swims = sum(one["stopped"].get("completed", 0) for one in fresh), sum(one["runs"] for one in fresh)
    if whole < 0.9 * swims:
        return f"; at half the time step, where {swims - whole} of {swims} swims end at a plane, it is not compared"
    found = study.pairs({name: [run["best"]["fresh"]["halfStep"]["distance"]["mean"] for run in runs] for name, runs in scene.own.items()})
    def open_difference(row):
        spans = f", but the interval of the medians' difference, {row['low']:.3f} to {row['high']:.3f}, takes in 0" if row["p_holm"] < 0.05 else ""
        return f"{row['first']} and {row['second']} (p {study.chance(row['p_holm'])}{spans})"
    alike = [open_difference(row) for row in found if "further" not in row["verdict"]]
    if len(alike) == len(found):
        return f"; {by}at half the time step no difference is sure (p {study.chance(min(row['p_holm'] for row in found))})"
    return f"; {by}at half the time step the difference between {', '.join(alike)} is not sure" if alike else f"; so {by}at half the time step"


def answer(tables):
    """What the tests at the end say, by evaluations."""
    def told(row):
        if row.verdict.startswith("no difference"):
            return f"between {row['first']} and {row['second']} no difference is seen (p {study.chance(row.p_holm)})"
        return f"{row.verdict.split(' (')[0].replace(' further than', ' does better than')} (p {study.chance(row.p_holm)})"
    return "**" + "; ".join(f"with {scene.name}{measure(scene)} " + ", ".join(told(row) for _, row in found[found.equal == TOLD].iterrows())
                            + at_half_step(scene) for scene, _, _, found in tables).replace("with", "With", 1) + ".**\n"


def choice_table(scene):
    losses = [loss for run in scene.runs if (loss := scene.loss(run)) is not None]
    ranks = [rank for rank in scene.ranks.values() if rank is not None]
    return study.table(["optimizer", "runs", "selection loss", "runs", "rank correlation"], [[
        "all", str(len(losses)), study.interval_text(study.median_interval(losses), 1, 100) + " %" if losses else "–",
        str(len(ranks)), study.interval_text(study.median_interval(ranks), 2) if ranks else "–"]])


def section(scene, again, differences):
    starts = max(4, 2 * scene.runs[0]["settings"].get("starts", 1))
    parts = [f"## {scene.name}", f"![best fitness against evaluations]({scene.name}.png)", said(scene.runs[0]["settings"]),
             f"Worth of the best gaits so far, from {starts} fresh starts each:", again_table(again),
             "Differences at the end:", tests_table(differences), "The choice:", choice_table(scene)]
    return "\n".join(part if part.endswith("\n") else part + "\n" for part in parts)


def said(settings):
    """What all runs of a scene have in common."""
    parts = [f"Scene `{settings['scene']}`", f"encoding {settings['encoding']}", f"backend {settings['backend']}"]
    if (settings.get("starts") or 1) > 1:
        parts += [f"{settings['starts']} starts", f"judged by {settings['judge']}"]
    parts += ["net fitness"] * (settings.get("fitness") == "net")
    parts += [f"scheme {scheme}" for scheme in [settings.get("scheme")] if scheme] + [f"{time} s" for time in [settings.get("duration")] if time]
    if settings.get("overrides"):
        parts.append(f"overrides `{json.dumps(settings['overrides'], separators=(',', ':'))}`")
    return ", ".join(parts) + "."


def draw(scene, file):
    """Best fitness against evaluations: the median of each optimizer's runs in a band from quartile to quartile."""
    chart = study.Chart(f"{scene.name}: median and quartiles of the runs", "evaluations", "best fitness so far", size=(9, 5.6))
    for colour, (name, runs) in zip(COLOURS, scene.own.items(), strict=False):
        curves = np.array([curve(run) for run in runs])
        lower, median, upper = np.quantile(curves, [0.25, 0.5, 0.75], axis=0)
        x = np.arange(1, curves.shape[1] + 1)
        chart.axes.fill_between(x, lower, upper, color=colour, alpha=0.2, linewidth=0)
        chart.axes.plot(x, median, color=colour, label=f"{name} ({len(runs)})")
    chart.save(file)


def make(folder, data):
    optimizers = list(planned(data)["optimizers"])
    scenes = [Scene(data, file.name.removesuffix("-again.jsonl"), optimizers) for file in sorted(data.glob("*-again.jsonl"))]
    tables = [(scene, frame(scene), medians(scene), tests(scene)) for scene in scenes]
    for k, name in enumerate(["comparison", "fresh", "tests"], 1):
        pandas.concat([parts[k] for parts in tables]).to_csv(folder / f"{name}.csv", index=False)
    page, sections = data / "README.md", {scene.name: section(scene, again, differences) for scene, _, again, differences in tables}
    if not page.exists():
        page.write_text("# Optimizers side by side\n" + "".join(f"\n<!-- {name} -->\n<!-- /{name} -->\n" for name in sections), encoding="utf-8")
    if data == study.ROOT / "results/optimizers":
        sections["answer"] = answer(tables)
    (folder / page.name).write_text(study.filled(page, **sections), encoding="utf-8")
    for scene in scenes:
        draw(scene, folder / f"{scene.name}.png")


def planned(folder):
    """What FOLDER/study.json asks for. Raises OSError and ValueError."""
    plan = json.loads((folder / "study.json").read_text(encoding="utf-8"))
    missing = {"scenes", "optimizers", "seeds", "arguments", "computing"} - plan.keys()
    if missing:
        raise ValueError(f"{folder / 'study.json'}: lacks {', '.join(sorted(missing))}")
    return plan


def run(folder):
    plan = planned(folder)
    for scene, (optimizer, arguments) in itertools.product(plan["scenes"], plan["optimizers"].items()):
        print(scene, optimizer, flush=True)
        natator(folder, "evolve", "--scene", scene, "--seeds", str(plan["seeds"]), "--output-dir", place_of(scene, optimizer), *arguments,
                *plan["arguments"], *plan["computing"], *(["--runs-at-once", str(plan["atOnce"])] if "atOnce" in plan else []))
    for scene in plan["scenes"]:
        keep(folder, plan, scene)


def natator(folder, *arguments):
    """Runs the program in the folder of a study, by whose place the names of files in study.json are meant."""
    program = os.environ.get("NATATOR") or study.ROOT / "build/release/bin/natator"
    done = subprocess.run([program, *arguments], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode:
        raise OSError(f"natator {arguments[0]} ended with {done.returncode}: {done.stderr.strip().splitlines()[-1:]}")


def place_of(scene, optimizer):
    return f"runs/{pathlib.Path(scene).stem}/{optimizer}"


def keep(folder, plan, scene):
    """Runs the best gaits of a scene's runs again, and writes down what they did."""
    name = pathlib.Path(scene).stem
    own = list(itertools.product(plan["optimizers"], range(1, plan["seeds"] + 1)))
    places = [f"{place_of(scene, optimizer)}/seed-{seed}" for optimizer, seed in own]
    settings = json.loads((folder / places[0] / "config.json").read_text(encoding="utf-8"))
    ranking = ["--rank-starts", str(plan["rankStarts"])] if plan.get("rankStarts") else []
    with tempfile.TemporaryDirectory() as scratch:
        file = pathlib.Path(scratch, "runs.jsonl")
        natator(folder, "compare", "--starts", str(max(4, 2 * (settings.get("starts") or 1))), "--json", file, *ranking,
                *plan["computing"], *places)
        found = lines(file)
    kept, again, ranks = [], [], []
    for (optimizer, seed), row in zip(own, found, strict=True):
        del row["run"]
        for part in ("settings", "best"):
            row[part]["scene"] = scene  # not where the file lay
        again += [{"optimizer": optimizer, "seed": seed} | one for one in row.pop("again")]
        if last := row.pop("last", None):
            worths = [float(JUDGES[settings.get("judge", "mean")](one["runs"])) for one in last]
            correlation = stats.spearmanr([one["selected"] for one in last], worths).statistic if len(last) > 1 else np.nan
            ranks.append({"optimizer": optimizer, "seed": seed, "starts": plan["rankStarts"], "gaits": len(last),
                          "spearman": None if np.isnan(correlation) else float(correlation)})
        kept.append({"optimizer": optimizer} | row)
    for end, rows in (("", kept), ("-again", again), ("-ranks", ranks)):
        (folder / f"{name}{end}.jsonl").write_text("".join(json.dumps(row, separators=(",", ":")) + "\n" for row in rows), encoding="utf-8")


if __name__ == "__main__":
    study.main(make, run, any_folder=True)
