"""The page's figures: of fresh swims of the fry in `lattice`; of the eel's fresh runs, its twelve candidates and the winner at half the spacing."""
import csv
import json
import math
import pathlib
import statistics

from scipy import stats
import study

HERE = pathlib.Path(__file__).parent
SECONDS = 4  # of a run


def lines(name):
    return [json.loads(line) for line in (HERE / name).read_text(encoding="utf-8").splitlines()]


def sample(values):
    """Mean, standard error, and half its 95 % interval by Student's t."""
    error = statistics.stdev(values) / math.sqrt(len(values))
    return statistics.fmean(values), error, error * stats.t.ppf(0.975, len(values) - 1)


def ranges(values, decimals):
    return " to ".join(study.fixed(end, decimals) for end in (min(values), max(values)))


LENGTH = 1.45  # of the fry's particles
LEVELS = ("cells of 0.025", "cells of 0.01875", "… half the time step", "cells of 0.0125")  # lattice.py's


def fry():
    """Answer and tables of the fry: speeds by seed and level, until 4 s or a wall."""
    found = {}
    for one in lines("lattice/fresh.jsonl"):
        if one["status"] != "ok":
            raise ValueError(f"lattice/fresh.jsonl: swim {one['id']} is {one['status']}")
        seed, number = divmod(one["id"], 1000)
        found.setdefault((seed, number if number > 900 else number // 100), []).append(one)
    speed = {key: [one["distance"] / one["simulated"] / LENGTH for one in own] for key, own in found.items()}
    seeds = sorted({seed for seed, _ in found})

    def cell(seed, level):
        mean, _, interval = sample(speed[seed, level])
        return study.with_error(mean, interval, 3)

    rows = [[name] + [cell(seed, level) for seed in seeds] for level, name in enumerate(LEVELS)]
    rows += [[name] + [study.fixed(speed[seed, number][0], 3) for seed in seeds] for number, name in ((902, "cells of 0.01875 in a tank 1.65 by 1.95, one swim"), (901, "… at rest, one swim"))]
    best = max(seeds, key=lambda seed: statistics.fmean(speed[seed, 1]))
    mean = {level: statistics.fmean(speed[best, level]) for level in range(len(LEVELS))}
    (base, _, interval), others = sample(speed[best, 1]), [statistics.fmean(speed[seed, 1]) for seed in seeds if seed != best]
    answer = f"**In `lattice` an evolved fry swims {study.with_error(base, interval, 2)} body lengths/s, {study.fixed(mean[2], 2)} at half the time step, {study.fixed(mean[0], 2)} " \
             f"in cells and steps a third wider and {study.fixed(mean[3], 2)} in ones a third narrower;** two other evolutions {' and '.join(study.fixed(one, 2) for one in others)}. "
    swims = [one["swimming"] for one in found[best, 1]]
    reynolds, strouhal = (statistics.fmean(one[name] for one in swims) for name in ("reynolds", "strouhal"))
    frequency = json.loads((HERE / f"lattice/seed-{best}-best.json").read_text(encoding="utf-8"))["gait"]["frequency"]
    finer = statistics.fmean(one["swimming"]["strouhal"] for one in found[best, 3])
    does = f"- {frequency:.2f} beats/s, {study.fixed(base / frequency, 2)} lengths in each (eels 0.26 to 0.5: Kern and Koumoutsakos 2006)\n" \
           f"- Reynolds number {reynolds:.0f}, Strouhal number {study.fixed(strouhal, 2)} ({study.fixed(finer, 2)} in the finest cells): " \
           f"{study.fixed(strouhal / study.larva(reynolds), 1)} times a larva's\n" \
           f"- tail beat {study.fixed(statistics.fmean(one['tailAmplitude'] for one in swims) / LENGTH, 2)} lengths, two to three times a fish's\n" \
           f"- turn in 4 s: {ranges([abs(math.degrees(one['course']['yaw'])) for one in found[best, 1]], 0)} degrees\n"
    return answer, study.table(["body lengths/s by seed"] + list(map(str, seeds)), rows), does


def make(folder):
    converge = json.loads((HERE / "converge.json").read_text(encoding="utf-8"))
    length, levels = converge["bodyLength"], {one["level"]: one["speed"]["mean"] / converge["bodyLength"] for one in converge["levels"]}
    asked = {one["id"]: one for one in lines("fresh.jsonl")}
    runs = {"base": [], "half": [], "rest": []}
    for one in lines("fresh-results.jsonl"):
        request = asked[one["id"]]
        runs["half" if "overrides" in request else "base" if any(request["gait"]["amplitude"]) else "rest"].append(one)
    ways = {name: [one["distance"] / SECONDS / length for one in own] for name, own in runs.items()}
    (base, base_error, base_interval), (half, half_error, half_interval) = sample(ways["base"]), sample(ways["half"])
    with open(HERE / "candidates.csv", encoding="utf-8", newline="") as file:
        candidates = [{key: float(value) for key, value in row.items() if key != "evolution"} for row in csv.DictReader(file)]
    # Two starts say little of their own spread: that of all candidates counts.
    pooled = {level: math.sqrt(statistics.fmean(one[f"{level}_se"]**2 for one in candidates)) for level in ("base", "half_spacing")}
    student = stats.t.ppf(0.975, len(candidates))
    weights = [one["estimate_se"]**-2 for one in candidates]
    mean = sum(weight * one["estimate_bl_s"] for weight, one in zip(weights, candidates)) / sum(weights)
    step, spacing = half - base, levels["spacing/2"] - levels["base"]
    estimate = base + 2 * (step + spacing)
    scatter = math.hypot(2 * half_error, base_error, 2 * pooled["half_spacing"], 2 * pooled["base"])
    error = math.hypot(scatter, step, spacing)
    best = max(candidates, key=lambda one: one["estimate_bl_s"])
    frequency = asked[0]["gait"]["frequency"]

    def row(what, speed, interval):
        return [what, study.with_error(speed, interval, 3), study.with_error(speed / frequency, interval / frequency, 3)]

    speeds = study.table(["", "body lengths/s", "in a beat"], [
        row("as it evolved: spacing 0.1, 4 substeps, 3 fresh starts", base, base_interval),
        row("half the time step, 6 fresh starts", half, half_interval),
        row("half the spacing, the 2 starts that chose it", levels["spacing/2"], student * pooled["half_spacing"]),
        row("estimate for time step and spacing 0, fresh starts at the scene's spacing", estimate, error),
        row("… by the starts that chose it", best["estimate_bl_s"], best["estimate_se"]),
        ["… mean of the twelve candidates", study.fixed(mean, 3), ""],
        ["with muscles at rest", study.fixed(statistics.fmean(ways["rest"]), 3), ""]])
    of_fry, fry_speeds, fry_does = fry()
    answer = of_fry + f"In `conserving` an eel swims {study.fixed(base, 2)} at a spacing of 0.1 and {study.fixed(levels['spacing/2'], 2)} at half of it; " \
             f"extrapolated to time step and spacing 0, {study.with_error(estimate, error, 2)} (standard error). It was chosen from twelve, whose mean estimate, weighted by errors, is " \
             f"{study.fixed(mean, 2)}.\n"
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=answer, fry_speeds=fry_speeds, fry_does=fry_does, speeds=speeds), encoding="utf-8")


study.main(make)
