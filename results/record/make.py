"""The page's figures, of the fresh runs, the twelve candidates and the winner at half the spacing."""
import csv
import json
import math
import pathlib
import statistics

from scipy import stats
import study

HERE = pathlib.Path(__file__).parent
VISCOSITY, SECONDS = 0.002, 4  # as set, units²/s; of a run
MASS = 142 * 0.421875  # of the body's particles


def lines(name):
    return [json.loads(line) for line in (HERE / name).read_text(encoding="utf-8").splitlines()]


def sample(values):
    """Mean, standard error, and half its 95 % interval by Student's t."""
    error = statistics.stdev(values) / math.sqrt(len(values))
    return statistics.fmean(values), error, error * stats.t.ppf(0.975, len(values) - 1)


def ranges(values, decimals):
    return " to ".join(study.fixed(end, decimals) for end in (min(values), max(values)))


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
    alike = [one for one in candidates if one["estimate_bl_s"] > 0]
    middle = sum(one["estimate_bl_s"] * one["estimate_se"]**-2 for one in alike) / sum(one["estimate_se"]**-2 for one in alike)
    chi = sum(((one["estimate_bl_s"] - middle) / one["estimate_se"])**2 for one in alike)
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
        ["… mean of the twelve candidates", study.with_error(mean, sum(weights)**-0.5, 3), ""],
        ["with muscles at rest", study.fixed(statistics.fmean(ways["rest"]), 3), ""]])
    water = study.water_viscosity(VISCOSITY)
    swims, halves = ([one["swimming"] for one in runs[name]] for name in ("base", "half"))
    reynolds = statistics.fmean(one["reynolds"] for one in swims)
    own, strouhal = reynolds * VISCOSITY / water, [one["strouhal"] for one in swims]
    work = statistics.fmean(one["work"] / one["distance"] for one in runs["base"])
    speed = base * length
    answer = f"**An evolved eel swims {study.fixed(base, 2)} body lengths/s at a spacing of 0.1 and {study.fixed(levels['spacing/2'], 2)} at half of it; " \
             f"extrapolated to time step and spacing 0, {study.with_error(estimate, error, 2)}.** It was chosen from twelve, of which eleven do " \
             f"not differ (χ² = {chi:.1f}, {len(alike) - 1} degrees of freedom, p = {stats.chi2.sf(chi, len(alike) - 1):.2f}); their mean estimate is " \
             f"{study.with_error(mean, sum(weights)**-0.5, 2)}, as one has that was not selected.\n"
    does = f"- frequency: {frequency:.2f} beats/s\n" \
           f"- Reynolds number: {reynolds:.0f} by the set viscosity, {own:.0f} by [the water's](../water/README.md)\n" \
           f"- Strouhal number: {ranges(strouhal, 2)}, {ranges([one / study.larva(own) for one in strouhal], 1)} times a larva's at {own:.0f}; at half the " \
           f"time step {ranges([one['strouhal'] for one in halves], 2)}\n" \
           f"- tail beat: {study.fixed(statistics.fmean(one['tailAmplitude'] for one in swims) / length, 2)} body lengths (half the time step: " \
           f"{study.fixed(statistics.fmean(one['tailAmplitude'] for one in halves) / length, 2)}), two to three times a fish's\n" \
           f"- cost of transport: {work:.0f} mass · length/s²; of a unit of the body's mass {study.fixed(work / MASS, 0)} length/s², " \
           f"{study.fixed(work / MASS / (speed**2 / length), 0)} U²/L\n" \
           f"- turn in 4 s: {ranges([abs(math.degrees(one['course']['yaw'])) for one in runs['base'] + runs['half']], 0)} degrees\n"
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=answer, speeds=speeds, does=does), encoding="utf-8")


study.main(make)
