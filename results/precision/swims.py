#!/usr/bin/env python3
"""Whole swims at ever smaller time steps and spacings, eight starts each, and in double, into swims.csv: distances of those that touch no plane, and the
processor time of a swim.

    NATATOR_SIM=build/release/bin/natator-sim python3 results/precision/swims.py [SCHEME]... > results/precision/swims.csv

A row is written as soon as its starts are done."""
import csv
import pathlib
import resource
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from lakes import answers, gait  # noqa: E402

STARTS, ITERATIONS = 8, 4
CREATURE_1 = {"frequency": 1.861, "amplitude": [0.973, 0.69], "phase": [0, 0.648]}  # the thesis' gait
# Of each scheme: scene, gait, seconds, substeps in double, and (parts of the spacing, substeps).
SWIMS = {"flex": ("thesis/creature-1", CREATURE_1, (1, 2, 4), 4, [(1, 2), (1, 4), (1, 8), (1, 16), (1, 32), (1, 64)]),
         "conserving": ("pool/creature-2", gait("fish-like"), (1, 3), 4, [(1, 2), (1, 4), (1, 8), (1, 16), (1, 32), (2, 4), (2, 8), (3, 4)]),
         "lattice": ("plane/loach", gait("loach"), (1, 2, 4), 24, [(1, 12), (1, 24), (1, 48), (1, 96), (2, 48), (2, 96), (3, 72)])}


LONG = {"planes": [[0, 1, 0, 0], [1, 0, 0, 0], [-1, 0, 0, 4.4], [0, 0, 1, 0], [0, 0, -1, 1.2]]}  # the pool, for 3 s


def finer(scheme, n):
    """The scene's water and body in particles, or cells, n times as fine."""
    if scheme == "flex":
        return {"solver": {}}
    count, spacing, origin, mass, lengths = {
        "conserving": ([44, 12, 12], 0.1, [0.05 / n] * 3, n**-3, {"radius": 0.15, "fluidRestDistance": 0.1, "solidRestDistance": 0.075, "collisionDistance": 0.05}),
        "lattice": ([160, 1 / n, 80], 0.02, [0.01 / n, 0.01, 0.01 / n], n**-2, {"radius": 0.03, "fluidRestDistance": 0.02, "solidRestDistance": 0.02, "collisionDistance": 0.04})}[scheme]
    fluid = {"count": [round(one * n) for one in count], "spacing": spacing / n, "origin": origin, "mass": {"bottom": mass, "top": mass}}
    changes = {"solver": {name: length / n for name, length in lengths.items()}, "fluid": fluid, "creature": {"refinement": n}}
    if scheme == "conserving":
        fluid["clearance"] = 0.085 / n
        changes["creature"]["rearCentre"] = [0.7, 0.6, 0.6]
        changes |= LONG
    return changes


def swim(scheme, precision, n, substeps, seconds):
    """Distances of the starts that are swum to their end, and the processor time of one."""
    scene, own, *_ = SWIMS[scheme]
    overrides = finer(scheme, n)
    overrides["solver"] |= {"substeps": substeps} | ({} if scheme == "lattice" else {"numIterations": ITERATIONS})
    overrides["stopping"] = {"planeContact": True, "noProgressAfter": 0}
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    found = answers({"id": start, "scene": scene, "precision": precision, "duration": seconds, "start": start, "gait": own, "overrides": overrides} for start in range(1, STARTS + 1))
    used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return [one["distance"] for one in found.values() if one.get("stopped") == "completed"], used / STARTS


def main():
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(["scheme", "scene", "precision", "finer", "substeps", "seconds", "starts", "distance", "standard_deviation", "processor_seconds"])
    for scheme in sys.argv[1:] or SWIMS:
        scene, _, times, double, levels = SWIMS[scheme]
        for precision, n, substeps, seconds in [*(("float", *level, seconds) for level in levels for seconds in times), ("double", 1, double, times[-1])]:
            ways, used = swim(scheme, precision, n, substeps, seconds)
            mean = [f"{value:.5f}" for value in (statistics.fmean(ways), statistics.stdev(ways))] if len(ways) > 1 else ["", ""]
            rows.writerow([scheme, scene, precision, n, substeps, seconds, len(ways), *mean, f"{used:.3f}"])
            sys.stdout.flush()


main()
