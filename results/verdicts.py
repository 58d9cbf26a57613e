#!/usr/bin/env python3
"""Recomputes the numbers of pages' answers from their rows once more, by other code than their make.py: .readers/bin/python results/verdicts.py

For pages whose make.py is longer than they are. Exit code 1 where an answer does not say what its rows give."""
import json
import pathlib
import re
import sys

import numpy as np
import pandas as pd
from scipy import stats

HERE = pathlib.Path(__file__).resolve().parent


def lines(file):
    return [json.loads(line) for line in (HERE / file).read_text(encoding="utf-8").splitlines()]


def table(file):
    return pd.read_csv(HERE / file)


def cluster():
    for variant, words in (("one run, 150 gaits", "up to {} executors"), ("32 runs at once, 150 gaits × 8 starts", "eight starts a gait {}")):
        own = table("cluster/efficiency.csv").query("variant == @variant").sort_values("executors")
        yield words.format(own.executors[(own.efficiency >= 0.8).cummin()].max())


def endless():
    scene = {one["id"]: one["scene"] for one in lines("endless/requests.jsonl") if one["duration"] == 4}
    runs = {kind: [one for one in lines("endless/results.jsonl") if scene.get(one["id"], "").startswith(kind)] for kind in ("endless", "open-water")}
    moving, fixed = (np.array([one["distance"] for one in own]) for own in runs.values())
    test = stats.ttest_ind(moving, fixed)
    low, high = 100 * np.array(test.confidence_interval()) / fixed.mean()
    yield f"{(low + high) / 2:.1f} ± {(high - low) / 2:.1f} %"
    yield "No difference" if test.pvalue > 0.05 else "Distances differ"
    yield "cavities are " + " and in the fixed one ".join(f"{np.mean(own):.2f} ± {stats.sem(own):.2f}" for own in ([one["swimming"]["cavities"] for one in some] for some in runs.values()))


def flex_comparison():
    own = table("flex-comparison/comparison.csv")
    spread = np.hypot(own.flex_sd.fillna(own.ours_sd), own.ours_sd)
    near = (own.ours_mean - own.flex_mean).abs() <= spread
    for medium, words in (("fluid", "In fluid {} of {} speeds lie within one spread of several runs of Flex, {} of {} of one run"), ("vacuum", "in vacuum {} of {} and {} of {}")):
        some = [near[(own.medium == medium) & several] for several in (own.flex_n > 1, own.flex_n == 1)]
        yield words.format(*(number for one in some for number in (one.sum(), len(one))))


def learning():
    swum = table("learning/swims.csv")
    swum["speed"] = swum["return"] / 4

    def ends(task, column):
        means = swum[(swum.task == task) & swum.swimmer.str.match(f"{task}-[123]")].groupby(["swimmer", "level"])[column].agg("sum" if column == "reached" else "mean")
        return " to ".join(f"{round(end, 2):g}" for end in (means.min(), means.max()))

    speed = swum[(swum.task == "ahead") & (swum.swimmer == "evolved")].groupby("level").speed.mean()
    yield f"ahead at {ends('ahead', 'speed')} body lengths/s (the evolved gait: {round(speed.min(), 2):g} to {round(speed.max(), 2):g})"
    yield f"reach {ends('turn', 'reached')} of 16 targets"
    yield f"stay {ends('station', 'away')} body lengths from a station in a current"


def optimizers():
    again = {}
    for scene in ("creature-1", "loach"):
        for one in lines(f"optimizers/{scene}-again.jsonl"):
            again[scene, one["optimizer"], one["seed"], tuple(one["genes"])] = np.mean(one["runs"])
        found = {}
        for run in lines(f"optimizers/{scene}.jsonl"):
            best = run["best"]
            worth = best["fresh"]["again"] if "fresh" in best else again[scene, run["optimizer"], run["settings"]["seed"], tuple(best["genes"])]
            found.setdefault(run["optimizer"], []).append(worth)
        pairs = [("jgap-corrected", "cma-es"), ("jgap-corrected", "random"), ("cma-es", "random")]
        raw = {pair: stats.mannwhitneyu(found[pair[0]], found[pair[1]], method="exact").pvalue for pair in pairs}
        held = 0
        for rank, pair in enumerate(sorted(pairs, key=raw.get)):
            held = max(held, min(1, (3 - rank) * raw[pair]))  # Holm
            said = "< 0.001" if held < 0.001 else f"= {held:.{3 if held < 0.1 else 2}f}"
            first, second = sorted(pair, key=lambda name: -np.median(found[name]))
            yield f"between {pair[0]} and {pair[1]} no difference is seen (p {said})" if held > 0.05 else f"{first} does better than {second} (p {said})"


def precision():
    errors = table("precision/precision.csv").query("precision == 'float' and iterations == 4").pivot(index=["scheme", "scene"], columns="substeps", values="path_error_0.25")
    falls = (errors[1] > 5 * errors[32]).groupby("scheme")
    yield "less than a fifth " + " and ".join(f"in `{scheme}` in {own.sum()} of {len(own)}" for scheme, own in falls)
    for scheme, own in table("precision/swims.csv").query("precision == 'float'").groupby("scheme"):
        *others, finest = own[own.seconds == own.seconds.max()].dropna().sort_values("processor_seconds").itertuples()
        near = None
        for one in reversed(others):
            test = stats.ttest_ind(*(norm(swim) for swim in (one, finest)), equal_var=False).confidence_interval()
            if max(abs(test.low), abs(test.high)) > 0.1 * abs(finest.distance):
                break
            near = one.processor_seconds
        yield f"in `{scheme}` " + (f"by all settings from {near:.2g} s of a core on" if near else "by none that was tried")


def norm(swim):
    """So many numbers with a row's mean and standard deviation."""
    own = stats.norm.ppf((np.arange(swim.starts) + 0.5) / swim.starts)
    return swim.distance + swim.standard_deviation * own / own.std(ddof=1)


def quick_evolution():
    runs = [HERE / f"quick-evolution/loach-seed-{seed}" for seed in (1, 2, 3)]
    fresh = [json.loads((run / "best.json").read_text(encoding="utf-8"))["fresh"] for run in runs]
    base, half = ([one[level]["bodyLengths"]["mean"] for one in fresh] for level in ("base", "halfStep"))
    cells = [-level["change"]["mean"] for run in runs if (run / "converge.json").exists()
             for level in json.loads((run / "converge.json").read_text(encoding="utf-8"))["levels"] if level["level"] == "spacing/2"]
    lost = [1 - after / before for before, after in zip(base, half)]
    yield f"of {min(base):.1f} to {max(base):.1f} body lengths/s by 3 seeds"
    yield f"by {100 * min(lost):.0f} to {100 * max(lost):.0f} % at half the time step, by {100 * min(cells):.0f} to {100 * max(cells):.0f} % at half the cells and steps"


def record():
    speed = {}
    for one in lines("record/lattice/fresh.jsonl"):
        seed, number = divmod(one["id"], 1000)
        speed.setdefault((seed, number // 100), []).append(one["distance"] / one["simulated"] / 1.45)
    best, *others = sorted({seed for seed, _ in speed}, key=lambda seed: -np.mean(speed[seed, 1]))
    own = speed[best, 1]
    yield f"swims {np.mean(own):.3f} ± {stats.sem(own) * stats.t.ppf(0.975, len(own) - 1):.3f} body lengths/s, {np.mean(speed[best, 2]):.2f} at half the time step, " \
          f"{np.mean(speed[best, 0]):.2f} in cells and steps a third wider and {np.mean(speed[best, 3]):.2f} in ones a third narrower"
    yield "two other evolutions " + " and ".join(f"{np.mean(speed[seed, 1]):.2f}" for seed in sorted(others))


def schools():
    swims = pd.DataFrame(lines("schools/street.jsonl"))
    swims = swims[swims.power.notna() & (swims.unstable.isna() if "unstable" in swims else True)]
    for (n, steps), words in (((1, 1), "free water by {}"), ((1, 2), "at half the step {}"), ((2, 1), "in half the cells {}")):
        own = swims[(swims.n == n) & (swims.steps == steps)]
        behind, free = (own[(own.diameter == wide) & (own.behind == far)].power for wide, far in ((0.3, 1.0), (0, 1.5)))
        relative = [stats.sem(some) * stats.t.ppf(0.975, len(some) - 1) / some.mean() for some in (behind, free)]
        ratio = behind.mean() / free.mean()
        yield words.format(f"{100 * (1 - ratio):.0f} ± {100 * ratio * np.hypot(*relative):.0f} % ({len(behind)} swims)")


def water():
    """Targets reached surely and by the mean alone, and cases that miss one, at resolution 20 and at the finest that a GPU has, by its smallest steps."""
    rows = table("water/water.csv")
    rows = rows[(rows.scheme == "conserving") & rows.support.isin([2.5]) & (rows.modified_pressure == "no") & (rows.least.notna() | rows.greatest.notna())
                & (rows.iterations == 4) & ~rows.quantity.str.contains("side")]
    scale = rows.reference.where(rows.quantity.str.startswith(("viscosity", "period")), 1)  # starts have references of their own
    rows = rows.assign(value=rows.value / scale, least=rows.least.fillna(-np.inf) / scale, greatest=rows.greatest.fillna(np.inf) / scale)
    counts = {"coarse": [], "finest": []}
    for (case, _), own in rows.groupby(["case", "quantity"]):
        coarse = own[(own.resolution == 20) & (own.substeps == 2)]
        coarse = coarse[coarse.backend == ("cpu" if "cpu" in set(coarse.backend) else "cuda")]
        finest = own[(own.resolution == own.resolution.max()) & (own.backend == "cuda")]
        for name, some in (("coarse", coarse), ("finest", finest[finest.substeps == finest.substeps.max()])):
            mean, half = some.value.mean(), stats.t.ppf(0.975, len(some) - 1) * stats.sem(some.value) if len(some) > 1 else 0
            low, high = some.least.mean(), some.greatest.mean()
            counts[name].append((case, low <= mean - half and mean + half <= high, low <= mean <= high))
    (sure, mean), (finely, fine) = ((sum(one[1] for one in own), sum(one[2] and not one[1] for one in own)) for own in counts.values())
    missed = {case for case, _, reached in counts["coarse"] if not reached}
    yield f"{sure} of {len(counts['coarse'])} targets are reached for sure at resolution 20, {mean} more by the mean, at the finest {finely} and {fine}"
    yield f"{len(missed)} of {rows.case.nunique()} cases miss one at 20"


def main():
    pages, wrong = (cluster, endless, flex_comparison, learning, optimizers, precision, quick_evolution, record, schools, water), []
    for page in pages:
        folder = page.__name__.replace("_", "-")
        answer = re.search(r"<!-- answer.*? -->\n(.*?)<!-- (?:/|end of )answer -->", (HERE / folder / "README.md").read_text(encoding="utf-8"), re.DOTALL)[1]
        wrong += [f"results/{folder}: the answer does not say \"{said}\", which its rows give" for said in page() if said not in answer]
    print("\n".join(wrong) or f"{len(pages)} answers are what their rows give")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
