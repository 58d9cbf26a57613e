#!/usr/bin/env python3
"""Whole swims at ever smaller time steps, eight starts each, into swims.csv: distance in 4 s, and the processor time of a swim.

    NATATOR_SIM=build/release/bin/natator-sim python3 results/precision/swims.py > results/precision/swims.csv

What is there already is computed again; a row is written as soon as its starts are done."""
import csv
import json
import os
import resource
import statistics
import subprocess
import sys

STARTS, SECONDS, ITERATIONS = 8, 4, 4
CREATURE_1 = {"frequency": 1.861, "amplitude": [0.973, 0.69], "phase": [0, 0.648]}  # the thesis' gait
FISH_LIKE = {"frequency": 2, "amplitude": [0.07, 0.12, 0.17, 0.22, 0.27, 0.32, 0.37, 0.42], "phase": [0, 0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 0.65]}
LOACH = {"frequency": 2, "amplitude": [0.4, 0.35, 0.3, 0.25, 0.2], "phase": [0, 0.902, 0.804, 0.706, 0.608]}
SWIMS = {"flex": ("thesis/creature-1", CREATURE_1, (2, 4, 8, 16, 32, 64)), "conserving": ("pool/creature-2", FISH_LIKE, (2, 4, 8, 16, 32)),
         "lattice": ("plane/loach", LOACH, (12, 24, 48, 96))}


def main():
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(["scheme", "scene", "substeps", "starts", "distance", "standard_deviation", "seconds"])
    for scheme, (scene, gait, all_substeps) in SWIMS.items():
        for substeps in all_substeps:
            solver = {"substeps": substeps} if scheme == "lattice" else {"substeps": substeps, "numIterations": ITERATIONS}
            asked = "".join(json.dumps({"id": start, "scene": scene, "duration": SECONDS, "start": start, "gait": gait, "overrides": {
                "solver": solver, "stopping": {"planeContact": False, "noProgressAfter": 0}}}) + "\n" for start in range(1, STARTS + 1))
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            done = subprocess.run([os.environ["NATATOR_SIM"], "serve"], input=asked, capture_output=True, text=True, check=True)
            used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
            found = [one["distance"] for one in map(json.loads, done.stdout.splitlines()) if one["status"] == "ok"]
            rows.writerow([scheme, scene, substeps, len(found), *(f"{value:.5f}" for value in (statistics.fmean(found), statistics.stdev(found))), f"{used / STARTS:.3f}"])
            sys.stdout.flush()


main()
