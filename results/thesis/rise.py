#!/usr/bin/env python3
"""Why do swimmers rise in open water? How far they are up after 2 s, and how far their heads, as they are and with one thing changed.

    python3 results/thesis/rise.py build/release/bin/natator-sim        # tables/rise.csv; minutes

The best gait of the first evolution of each creature, from two perturbed starts, on a processor.
"""
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import swims

HERE = pathlib.Path(__file__).resolve().parent
SECONDS = 2
STARTS = [1, 2]
WALLS = swims.tank(6, 1.6, 1.6, 1)["planes"]  # the scene's
CHANGES = {"as it is": {}, "resting muscles": {}, "a lid on the water": {"planes": [*WALLS, [0, -1, 0, 1.6]]},
           "gravity 12 instead of 3": {"solver": {"gravity": [0, -12, 0]}}, "half the time step": {"solver": {"substeps": 8}},
           "support 3.5 instead of 2.5": {"solver": {"kernelSupport": 3.5}}}


def swim(program, creature, change, start):
    """(way up of the body's middle, degrees by which the head is above the tail) after the swim."""
    gait = swims.best_gait(HERE / f"runs/creature-{creature}/open-water/seed-1")
    if change == "resting muscles":
        gait = swims.resting(gait)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "slices.csv"
        subprocess.run([program, "run", f"open-water/creature-{creature}", "--gait", json.dumps(gait), "--overrides",
                        json.dumps(CHANGES[change]), "--duration", str(SECONDS), "--perturbation", "0.0001", "--perturbation-seed",
                        str(start), "--trajectory", str(file)], check=True, stdout=subprocess.DEVNULL)
        with open(file, encoding="utf-8", newline="") as lines:
            rows = [[float(row[key]) for key in ("frame", "x", "y", "z")] for row in csv.DictReader(lines)]
    first, last = ([row[1:] for row in rows if row[0] == frame] for frame in (rows[0][0], rows[-1][0]))
    head, tail = sorted((0, -1), key=lambda end: -first[end][0])
    ahead, up, aside = (last[head][axis] - last[tail][axis] for axis in range(3))
    return (statistics.mean(place[1] for place in last) - statistics.mean(place[1] for place in first),
            math.degrees(math.atan2(up, math.hypot(ahead, aside))))


def main():
    program = sys.argv[1]
    asked = [(creature, change, start) for creature in (1, 2, 3, 4) for change in CHANGES for start in STARTS]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = dict(zip(asked, pool.map(lambda one: swim(program, *one), asked)))
    swims.row("", *(f"creature {creature}" for creature in (1, 2, 3, 4)))
    for change in CHANGES:
        cells = []
        for creature in (1, 2, 3, 4):
            rises, heads = zip(*(found[creature, change, start] for start in STARTS))
            cells.append(f"{min(rises):.2f} to {max(rises):.2f}, {min(heads):.0f}° to {max(heads):.0f}°")
        swims.row(change, *cells)


if __name__ == "__main__":
    main()
