#!/usr/bin/env python3
"""Whole swims at ever smaller time steps, eight starts each, and in double, into swims.csv: distance in 4 s, and the processor time of a swim.

    NATATOR_SIM=build/release/bin/natator-sim python3 results/precision/swims.py > results/precision/swims.csv

A row is written as soon as its starts are done."""
import csv
import pathlib
import resource
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from lakes import answers, gait  # noqa: E402

STARTS, SECONDS, ITERATIONS = 8, 4, 4
DOUBLE = {"flex": 4, "conserving": 4, "lattice": 24}  # substeps at which they swim in double, too
CREATURE_1 = {"frequency": 1.861, "amplitude": [0.973, 0.69], "phase": [0, 0.648]}  # the thesis' gait
SWIMS = {"flex": ("thesis/creature-1", CREATURE_1, (2, 4, 8, 16, 32, 64)), "conserving": ("pool/creature-2", gait("fish-like"), (2, 4, 8, 16, 32)),
         "lattice": ("plane/loach", gait("loach"), (12, 24, 48, 96))}


def main():
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(["scheme", "scene", "precision", "substeps", "starts", "distance", "standard_deviation", "seconds"])
    for scheme, (scene, own, all_substeps) in SWIMS.items():
        for precision, substeps in [*(("float", one) for one in all_substeps), ("double", DOUBLE[scheme])]:
            solver = {"substeps": substeps} if scheme == "lattice" else {"substeps": substeps, "numIterations": ITERATIONS}
            asked = [{"id": start, "scene": scene, "precision": precision, "duration": SECONDS, "start": start, "gait": own,
                      "overrides": {"solver": solver, "stopping": {"planeContact": False, "noProgressAfter": 0}}} for start in range(1, STARTS + 1)]
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            found = answers(asked)
            used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
            ways = [one["distance"] for one in found.values() if one["status"] == "ok"]
            rows.writerow([scheme, scene, precision, substeps, len(ways), *(f"{value:.5f}" for value in (statistics.fmean(ways), statistics.stdev(ways))), f"{used / STARTS:.3f}"])
            sys.stdout.flush()


main()
