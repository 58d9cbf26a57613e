#!/usr/bin/env python3
"""Are 60 chromosomes enough? What 150, as the thesis has, find in open water beside what 60 do.

    evolve() { python3 -c "import plan; print(*map(repr, plan.Evolution($1, 'open-water', 1, plan.Size(seeds=$2, population=150)).arguments()))" |
        xargs natator evolve --backend cuda --output-dir "population/runs/creature-$1/open-water"; }
    cd results/thesis; evolve 1 1; evolve 2 2; evolve 3 1; evolve 4 1; cd -
    python3 results/thesis/population.py > requests.jsonl
    natator-sim serve < requests.jsonl > results.jsonl
    python3 results/thesis/population.py results.jsonl      # tables/population.csv

The best gait of each evolution, from starts of its own in the scene in which gaits are judged, until it touches a wall.
"""
import csv
import json
import pathlib
import statistics

import recompute
import swims

HERE = pathlib.Path(__file__).resolve().parent
STARTS = [1, 2, 3, 4]


def evolutions():
    """(creature, chromosomes, folder) of each."""
    for creature in (1, 2, 3, 4):
        for study in (HERE, HERE / "population"):
            for folder in sorted((study / f"runs/creature-{creature}/open-water").glob("seed-*")):
                config = json.loads((folder / "config.json").read_text(encoding="utf-8"))
                yield creature, config["population"], folder


def requests():
    for number, (creature, _, folder) in enumerate(evolutions()):
        gait = swims.best_gait(folder)
        for start in STARTS:
            yield {"id": number * len(STARTS) + start, "scene": f"open-water/creature-{creature}", "duration": 4, "gait": gait, "start": start}


def searched(folder):
    """(evaluations, mean way of the best of the last ten generations) of an evolution."""
    with open(folder / "generations.csv", encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    return sum(int(row["evaluations"]) for row in rows), statistics.mean(float(row["best"]) for row in rows[-10:])


def main():
    results = swims.results(requests())
    groups = {}
    for number, (creature, chromosomes, folder) in enumerate(evolutions()):
        found = [results[number * len(STARTS) + start] for start in STARTS]
        speeds = [recompute.speed(one, "open-water") for one in found]
        groups.setdefault((creature, chromosomes), []).append((*searched(folder), statistics.mean(speeds), swims.standard_error(speeds),
                                                               statistics.mean(one["simulated"] for one in found)))
    swims.row("creature", "chromosomes", "evolutions", "evaluations of one", "way in the search", "speed in the scene", "a run ends after")
    for (creature, chromosomes), group in groups.items():
        evaluations, ways, speeds, errors, ends = zip(*group)
        swims.row(creature, chromosomes, len(group), swims.spread(evaluations, 0), swims.spread(ways, 3),
                  f"{swims.spread(speeds, 3)}, each ± {max(errors):.3f}", swims.spread(ends, 1, " s"))


if __name__ == "__main__":
    main()
