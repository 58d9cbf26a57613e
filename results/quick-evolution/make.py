"""The page's answer and tables, of the run folders' best.json and converge.json."""
import json
import math
import pathlib

import study

HERE = pathlib.Path(__file__).parent
SEEDS = {"loach": (1, 2, 3), "default": (1, 2)}


def read(kind, seed, name):
    file = HERE / f"{kind}-seed-{seed}" / name
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else None


def known(one, digits=2):
    """Mean ± standard deviation."""
    return study.with_error(one["mean"], one["sd"], digits)


def change(level):
    return study.with_error(100 * level["mean"], 100 * level["error"], 1).replace("-", "−") + " %"


def loach(seed):
    best, converge = read("loach", seed, "best.json"), read("loach", seed, "converge.json")
    base, half = best["fresh"]["base"], best["fresh"]["halfStep"]
    finer = next(level["change"] for level in converge["levels"] if level["level"] == "spacing/2") if converge else None
    return [str(seed), str(read("loach", seed, "savings.json")["evaluations"]), known(base["bodyLengths"]), known(half["bodyLengths"]), change(finer) if finer else "",
            f"{base['reynolds']:.0f}", f"{base['strouhal']:.2f}", study.fixed(best["vacuum"]["distance"] / 4 / best["bodyLength"], 2)]


def estimates():
    """In words of every seed, and how many surely change by more than 10 % at half the time step or half the cells and steps."""
    told, unconverged = [], 0
    for seed in SEEDS["loach"]:
        converge = read("loach", seed, "converge.json")
        if converge:
            largest = max(abs(level["change"]["mean"]) + 2 * level["change"]["error"] for level in converge["levels"] if "change" in level)
            least = max(abs(level["change"]["mean"]) - 2 * level["change"]["error"] for level in converge["levels"] if "change" in level)
            one, length = converge["estimate"], converge["bodyLength"]
            sign = "is converged to within 10 %" if largest < 0.1 else "is not" if least > 0.1 else "may be or not"
            unconverged += sign == "is not"
            told.append(f"seed {seed} {sign}: {study.with_error(one['speed'] / length, one['error'] / length, 2)} body lengths/s at time step and cells 0")
    return "Converged? " + "; ".join(told) + ".\n", unconverged


def pool(seed):
    best = read("default", seed, "best.json")
    base, half = best["fresh"]["base"]["distance"], best["fresh"]["halfStep"]["distance"]
    lost = half["mean"] / base["mean"] - 1
    # Standard error of a ratio of two means of four runs each.
    error = (1 + lost) * math.hypot(base["sd"] / base["mean"], half["sd"] / half["mean"]) / 2
    return [str(seed), str(read("default", seed, "savings.json")["evaluations"]), f"{best['selected']:.4f}", known(base, 3), known(half, 3),
            change({"mean": lost, "error": error}), study.fixed(best["vacuum"]["distance"], 4)]


def make(folder):
    fresh = [read("loach", seed, "best.json")["fresh"] for seed in SEEDS["loach"]]
    speeds = [one["base"]["bodyLengths"]["mean"] for one in fresh]
    lost = {"half the time step": [1 - one["halfStep"]["bodyLengths"]["mean"] / speed for one, speed in zip(fresh, speeds)],
            "half the cells and steps": [-level["change"]["mean"] for one in SEEDS["loach"] for level in (read("loach", one, "converge.json") or {"levels": []})["levels"] if level["level"] == "spacing/2"]}
    told, unconverged = estimates()
    answer = f"**The preset `quick` finds a swimmer of {min(speeds):.1f} to {max(speeds):.1f} body lengths/s by {len(speeds)} seeds, slower by " + \
             ", by ".join(f"{100 * min(some):.0f} to {100 * max(some):.0f} % at {what}" for what, some in lost.items()) + f": {unconverged} of {len(speeds)} have not converged to within 10 %.**\n"
    fish = study.table(["seed", "evaluations", "body lengths/s", "half the time step", "half the cells and steps", "Reynolds", "Strouhal", "in vacuum"],
                       [loach(seed) for seed in SEEDS["loach"]])
    pools = study.table(["seed", "evaluations", "best distance in 2 s", "again", "half the time step", "change", "in vacuum"], [pool(seed) for seed in SEEDS["default"]])
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=answer, loach=fish, estimates=told, pool=pools), encoding="utf-8")


study.main(make)
