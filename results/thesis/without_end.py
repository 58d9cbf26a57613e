#!/usr/bin/env python3
"""How long does creature 2 swim straight? Its winners in open water where no wall is ahead or beside them.

    python3 results/thesis/without_end.py > requests.jsonl
    natator-sim serve < requests.jsonl > results.jsonl
    python3 results/thesis/without_end.py results.jsonl     # tables/without-end.csv

The winner of each seed from two starts, 12 s or until it touches the floor, in a tank that goes along with it to all sides.
"""
import itertools
import math

import swims
import wider_tank

STARTS, DURATION = [1, 2], 12
TANK = swims.tank(3.2, 1.6, 3.2, 1.0)


def request(number, swim):
    gait, start = swim
    return {"id": number, "scene": "endless/creature-2", "duration": DURATION, "gait": gait, "start": start,
            "overrides": {**TANK, "movingTank": {"along": "xz", "step": 0.3}}}


def main():
    winners = wider_tank.winners()
    results = swims.results(itertools.starmap(request, enumerate(itertools.product(winners, STARTS))))
    swims.row("seed", "lasts", "way along x", "speed along x", "yaw at the end")
    for seed in range(len(winners)):
        found = [results[seed * len(STARTS) + k] for k in range(len(STARTS))]
        columns = [[one["simulated"] for one in found], [one["distance"] for one in found],
                   [one["distance"] / one["simulated"] for one in found], [math.degrees(one["course"]["yaw"]) for one in found]]
        shown = [", ".join(f"{value:.{digits}f}" for value in column) for column, digits in zip(columns, (1, 1, 2, 0))]
        swims.row(seed + 1, f"{shown[0]} s", shown[1], shown[2], f"{shown[3]}°")


if __name__ == "__main__":
    main()
