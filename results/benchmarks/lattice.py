#!/usr/bin/env python3
"""Cells' steps a second of swims in scheme lattice on a GPU, or of one on a core, from the difference of two durations, so that starts cost nothing. usage: lattice.py [--swims N] [--most CELLS] > lattice.csv; lattice.py --core > lattice-core.csv"""
import argparse
import csv
import pathlib
import random
import statistics
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import lakes  # noqa: E402

HEIGHT_AND_WIDTH = (1.2, 1.2)
# Width of cells and length of the water, units; frames of the shorter run of one swim, of 150, and of one on a core.
SIZES = ((0.075, 2.85, 120, 40, 120), (0.0375, 2.85, 120, 12, 40), (0.025, 2.85, 60, 12, 8), (0.0125, 2.85, 30, 3, 1), (0.00625, 2.85, 8, 0, 0))
REPEATS = 3


def gaits(count):
    chance = random.Random(1)
    return [{"frequency": 1.5 + chance.random(), "amplitude": [0.1 + 0.3 * chance.random()] * 8, "phase": [round(-k * chance.uniform(0.05, 0.15) % 1, 4) for k in range(8)]} for _ in range(count)]


def seconds(cell, sides, swims, frames, backend):
    requests = [{"id": k, "scene": "lake/creature-2", "gait": gait, "overrides": lakes.lake(sides, cell, 0.72, seconds=frames / 60)} for k, gait in enumerate(gaits(swims))]
    begin = time.time()
    answers = lakes.answers(requests, backend)
    took = time.time() - begin
    bad = [one for one in answers.values() if one["status"] != "ok" or one["frames"] != frames]
    if bad:
        raise SystemExit(f"lattice.py: {len(bad)} of {swims} swims in cells of {cell} did not last {frames} frames: {bad[0]}")
    return took


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--swims", type=int, help="only of so many")
    options.add_argument("--most", type=float, default=1e9, help="cells at most")
    options.add_argument("--core", action="store_true", help="one swim, by a thread of a processor")
    chosen = options.parse_args()
    backend = "cpu" if chosen.core else "cuda"
    to = csv.writer(sys.stdout, lineterminator="\n")
    to.writerow(["cell", "cells", "swims", "frames", "updates_per_s", "least", "most"])
    for cell, length, *frames_of in SIZES:
        sides = (length, *HEIGHT_AND_WIDTH)
        box = lakes.lake(sides, cell, 0.72)
        cells, substeps = 1, box["solver"]["substeps"]
        for count in box["fluid"]["count"]:
            cells *= count
        for swims, frames in ((1, frames_of[2]),) if chosen.core else zip((1, 150), frames_of):
            if frames == 0 or cells > chosen.most or chosen.swims not in (None, swims):
                continue
            seconds(cell, sides, swims, 1, backend)
            rates = [swims * cells * substeps * 2 * frames / (seconds(cell, sides, swims, 3 * frames, backend) - seconds(cell, sides, swims, frames, backend)) for _ in range(REPEATS)]
            to.writerow([cell, cells, swims, 3 * frames, *(f"{rate:.3g}" for rate in (statistics.median(rates), min(rates), max(rates)))])
            sys.stdout.flush()


main()
