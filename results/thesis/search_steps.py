#!/usr/bin/env python3
"""How coarse may a search be? Orders of gaits by coarser steps beside that by the steps that they are judged by.

    python3 results/thesis/search_steps.py > requests.jsonl
    natator-sim serve < requests.jsonl > results.jsonl
    python3 results/thesis/search_steps.py results.jsonl      # search-steps.csv, and tables/search-orders.csv

Gaits of each creature in open water: 12 drawn at random, and the winners of four evolutions. Each swims from one start with each of the steps,
and as it is judged from a second start, too: how far two starts order gaits alike is as much as can be asked of any steps. The last three have
a smaller tank, too, whose water is shallower and as much heavier, so that the pressure at the swimmer is the same.
"""
import csv
import json
import pathlib
import random

import swims

HERE = pathlib.Path(__file__).resolve().parent
CREATURES, DRAWN, SEEDS = [1, 2, 3, 4], 12, [1, 2, 3, 4]
ACTUATORS = {1: 2, 2: 8, 3: 5, 4: 3}
DURATION = 2.5


def steps(substeps, passes, of_solids):
    return {"solver": {"substeps": substeps, "numIterations": passes, "solidIterations": of_solids}}


def small_tank(length, height, width, rear):
    """Of the scene's pressure in the middle, where the swimmer is, its rear so far from the wall behind."""
    return {**swims.tank(length, height, width, rear), "solver": {"gravity": [0, -4.8 / height, 0]}}


def both(tank, solver):
    return {**tank, "solver": {**tank["solver"], **solver["solver"]}}


RUNS = {  # substeps x passes over the water, iterations of the solids in each: start, overrides, duration
    "4 × 4, 16": (1, steps(4, 4, 16), DURATION),
    "4 × 4, 16, another start": (2, steps(4, 4, 16), DURATION),
    "2 × 4, 32": (1, steps(2, 4, 32), DURATION),
    "1 × 4, 64": (1, steps(1, 4, 64), DURATION),
    "2 × 1, 128, small tank, 1.75 s": (1, both(small_tank(4, 1, 1.6, 0.5), steps(2, 1, 128)), 1.75),  # as creatures 1, 3 and 4 were searched
    "2 × 1, 64, small tank, 1.75 s": (1, both(small_tank(4, 1, 1.6, 0.5), steps(2, 1, 64)), 1.75),  # half of the body's iterations
    "2 × 1, 128, narrow tank": (1, both(small_tank(4.5, 1, 1.2, 0.5), steps(2, 1, 128)), DURATION),  # as creature 2 was
}


def drawn(creature, generator):
    count = ACTUATORS[creature]
    first, last, step = generator.random(), generator.random(), generator.random()
    return {"frequency": round(generator.uniform(0.2, 2), 4),
            "amplitude": [round(first + (last - first) * k / (count - 1), 4) for k in range(count)],
            "phase": [round(step * k % 1, 4) for k in range(count)]}


def gaits():
    """(creature, gait) of all that swim."""
    generator = random.Random(1)
    for creature in CREATURES:
        for _ in range(DRAWN):
            yield creature, drawn(creature, generator)
        for seed in SEEDS:
            file = HERE / f"runs/creature-{creature}/open-water/seed-{seed}/finalists.json"
            yield creature, json.loads(file.read_text(encoding="utf-8"))["gaits"][0]["gait"]


def requests():
    for number, (creature, gait) in enumerate(gaits()):
        for run, (start, overrides, duration) in enumerate(RUNS.values()):
            yield {"id": number * len(RUNS) + run, "scene": f"open-water/creature-{creature}", "duration": duration, "gait": gait,
                   "start": start, "overrides": overrides}


def ranks(values):
    order = sorted(values)
    return [order.index(v) + (order.count(v) - 1) / 2 for v in values]


def spearman(a, b):
    """Correlation of ranks."""
    x, y = ranks(a), ranks(b)
    mean = (len(x) - 1) / 2
    covariance = sum((p - mean) * (q - mean) for p, q in zip(x, y))
    return covariance / (sum((p - mean)**2 for p in x) * sum((q - mean)**2 for q in y))**0.5


def main():
    results = swims.results(requests())
    ways = {}
    for number, (creature, _) in enumerate(gaits()):
        for run, name in enumerate(RUNS):
            ways.setdefault((creature, name), []).append(results[number * len(RUNS) + run]["distance"])
    with open(HERE / "search-steps.csv", "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["creature", "gait", *RUNS])
        for creature in CREATURES:
            columns = [ways[creature, name] for name in RUNS]
            for number, row in enumerate(zip(*columns)):
                table.writerow([creature, "drawn" if number < DRAWN else "winner", *row])
    judged, *others = RUNS
    swims.row(f"order by {judged} and by", *(f"creature {c}" for c in CREATURES))
    for name in others:
        swims.row(name, *(f"{spearman(ways[c, judged], ways[c, name]):.2f}" for c in CREATURES))


if __name__ == "__main__":
    main()
