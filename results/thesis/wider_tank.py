#!/usr/bin/env python3
"""Do walls slow creature 2, which swims longest and widest? Its winners in open water in wider tanks.

    python3 results/thesis/wider_tank.py > requests.jsonl
    natator-sim serve < requests.jsonl > results.jsonl
    python3 results/thesis/wider_tank.py results.jsonl      # tables/wider-tank.csv

The winner of each seed from two starts, for a time in which it touches no wall in any of the tanks, and until it touches one, be it the end of
the tank, 4 s at most.
"""
import itertools
import sys

import recompute
import swims

WIDTHS, STARTS = [1.6, 2.4, 3.2], [1, 2]
SHORT, LONG = 2.1, 4  # s


def winners():
    study = recompute.Study()
    return [gait for creature, label, gait, _ in study.subjects("open-water") if creature == 2 and label.startswith("evolved")]


def request(number, swim):
    width, time, gait, start = swim
    return {"id": number, "scene": "open-water/creature-2", "duration": time, "gait": gait, "start": start,
            "overrides": swims.tank(6, 1.6, width, 1.0)}


def main():
    asked = list(itertools.product(WIDTHS, [SHORT, LONG], winners(), STARTS))
    results = swims.results(itertools.starmap(request, enumerate(asked)))
    found = {}
    for number, (width, time, _, _) in enumerate(asked):
        found.setdefault((width, time), []).append(results[number])
    swims.row("width of the tank", f"way in {SHORT} s", "a run ends after", "speed until then")
    for width in WIDTHS:
        if any(one["stopped"] != "completed" for one in found[width, SHORT]):
            sys.exit(f"wider_tank.py: a wall of the tank {width} wide was touched within {SHORT} s")
        ways = [one["distance"] for one in found[width, SHORT]]
        ends = [one["simulated"] for one in found[width, LONG]]
        speeds = [recompute.speed(one, "open-water") for one in found[width, LONG]]
        swims.row(width, swims.with_error(ways, 3), f"{min(ends):.1f} to {max(ends):.1f} s", swims.with_error(speeds, 2))


if __name__ == "__main__":
    main()
