#!/usr/bin/env python3
"""Are 60 chromosomes enough? Creature 2 in open water: what 150, as the thesis has, find beside what 60 do.

    natator reproduce --creature 2 --water open-water --population 150 --seeds 2 --generations 100 --phase evolve --compact \\
        --output-dir results/thesis/population
    python3 results/thesis/population.py > requests.jsonl
    natator-sim serve < requests.jsonl > results.jsonl
    python3 results/thesis/population.py results.jsonl      # the table for commentary.md

The best gait of each evolution, from starts of its own in the scene in which gaits are judged, until it touches a wall.
"""
import csv
import json
import pathlib
import statistics

import recompute
import swims

HERE = pathlib.Path(__file__).resolve().parent
SEEDS = "runs/creature-2/open-water/seed-*"
STARTS = [1, 2, 3, 4]


def evolutions():
    """(chromosomes, seed, folder) of each."""
    for study in (HERE, HERE / "population"):
        for folder in sorted(study.glob(SEEDS)):
            config = json.loads((folder / "config.json").read_text(encoding="utf-8"))
            yield config["population"], config["seed"], folder


def requests():
    for number, (_, _, folder) in enumerate(evolutions()):
        gait = json.loads((folder / "best.json").read_text(encoding="utf-8"))["gait"]
        for start in STARTS:
            yield {"id": number * len(STARTS) + start, "scene": "open-water/creature-2", "duration": 4, "gait": gait, "start": start}


def searched(folder):
    """(evaluations, mean way of the best of the last ten generations) of an evolution."""
    with open(folder / "generations.csv", encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    return sum(int(row["evaluations"]) for row in rows), statistics.mean(float(row["best"]) for row in rows[-10:])


def main():
    results = swims.results(requests())
    print("| chromosomes | seed | evaluations | way in the search | speed in the scene | a run ends after |")
    print("| ---: | ---: | ---: | ---: | ---: | ---: |")
    for number, (chromosomes, seed, folder) in enumerate(evolutions()):
        found = [results[number * len(STARTS) + start] for start in STARTS]
        speeds = [recompute.speed(one, "open-water") for one in found]
        ends = [one["simulated"] for one in found]
        evaluations, way = searched(folder)
        print(f"| {chromosomes} | {seed} | {evaluations} | {way:.3f} | {swims.with_error(speeds, 3)} | {statistics.mean(ends):.1f} s |")


if __name__ == "__main__":
    main()
