#!/usr/bin/env python3
"""Do walls slow creature 2, which they end? Its winners in open water in wider tanks.

    python3 results/thesis/wider_tank.py > requests.jsonl
    natator-sim serve < requests.jsonl > results.jsonl
    python3 results/thesis/wider_tank.py results.jsonl      # the table for commentary.md

The winner of each seed from two starts, for a time in which it touches no wall in any of the tanks, and until it touches one, 4 s at most.
"""
import itertools
import json
import statistics
import sys

import recompute

WIDTHS, STARTS, TIMES = [1.6, 2.4, 3.2], [1, 2], [1.15, 4]


def winners():
    study = recompute.Study()
    return [gait for creature, label, gait, _ in study.subjects("open-water") if creature == 2 and label.startswith("evolved")]


def swims():
    """(width, time, gait, start) of each swim."""
    return itertools.product(WIDTHS, TIMES, winners(), STARTS)


def requests():
    for number, (width, time, gait, start) in enumerate(swims()):
        yield {"id": number, "scene": "open-water/creature-2", "duration": time, "gait": gait, "start": start, "overrides": {
            "planes": [[0, 1, 0, 0], [1, 0, 0, 0], [-1, 0, 0, 6], [0, 0, 1, 0], [0, 0, -1, width]],
            "fluid": {"count": [60, 16, round(width / 0.1)]}, "creature": {"rearCentre": [1.0, 0.8, width / 2]}}}


def main():
    if len(sys.argv) == 1:
        for request in requests():
            print(json.dumps(request))
        return
    with open(sys.argv[1], encoding="utf-8") as lines:
        results = {result["id"]: result for result in map(json.loads, lines)}
    found = {}
    for number, (width, time, _, _) in enumerate(swims()):
        found.setdefault((width, time), []).append(results[number])
    print("| width of the tank | way in 1.15 s | a wall is touched after | speed until then |")
    print("| ---: | ---: | ---: | ---: |")
    for width in WIDTHS:
        ways = [one["distance"] for one in found[width, TIMES[0]]]
        if any(one["stopped"] != "completed" for one in found[width, TIMES[0]]):
            sys.exit(f"wider_tank.py: a wall of the tank {width} wide was touched within {TIMES[0]} s")
        ends = [one["simulated"] for one in found[width, TIMES[1]]]
        speeds = [one["distance"] / one["simulated"] for one in found[width, TIMES[1]]]
        print(f"| {width} | {statistics.mean(ways):.3f} ± {statistics.stdev(ways) / len(ways)**0.5:.3f} | {min(ends):.1f} to {max(ends):.1f} s "
              f"| {statistics.mean(speeds):.2f} ± {statistics.stdev(speeds) / len(speeds)**0.5:.2f} |")


if __name__ == "__main__":
    main()
