#!/usr/bin/env python3
"""How far an eel swims under more and less pressure, by kernels of different support, and in water twice as fine.

    python3 results/water/pressure.py > requests.jsonl
    natator-sim serve < requests.jsonl > results.jsonl
    python3 results/water/pressure.py results.jsonl      # pressure.csv, and its table for README.md
"""
import itertools
import json
import statistics
import sys

GAITS = {
    "fish-like": {"frequency": 2, "amplitude": [0.09, 0.14, 0.19, 0.24, 0.29, 0.34, 0.39, 0.44],
                  "phase": [0, 0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 0.65]},
    "short waves": {"frequency": 1.75, "amplitude": [0.92, 0.91, 0.91, 0.90, 0.89, 0.88, 0.87, 0.87],
                    "phase": [0, 0.8, 0.6, 0.4, 0.2, 0, 0.8, 0.6]},
}
GRAVITIES, SUPPORTS, REFINEMENTS, STARTS = [1, 3, 10], [2.5, 3.5], [1, 2], [1, 2, 3]
CASES = list(itertools.product(GAITS, GRAVITIES, REFINEMENTS, SUPPORTS))


def overrides(gravity, refinement, support):
    """The small pool and the body, each particle divided into refinement^3, as `natator-sim converge` does."""
    n = refinement
    return {
        "stopping": {"planeContact": False},
        "solver": {"gravity": [0, -gravity, 0], "kernelSupport": support, "radius": 0.15 / n, "fluidRestDistance": 0.1 / n,
                   "solidRestDistance": 0.075 / n, "collisionDistance": 0.05 / n},
        "fluid": {"count": [26 * n, 10 * n, 10 * n], "spacing": 0.1 / n, "origin": [0.05 / n] * 3, "clearance": 0.085 / n,
                  "mass": {"bottom": 1 / n**3, "top": 1 / n**3}},
        "creature": {"refinement": n},
    }


def requests():
    for number, (case, start) in enumerate(itertools.product(CASES, STARTS)):
        gait, *changes = case
        yield {"id": number, "scene": "pool/eel", "duration": 1.5, "gait": GAITS[gait], "start": start,
               "overrides": overrides(*changes)}


def table(results):
    """For each case the mean and standard error of the distance, and the mean of the cavities."""
    runs = {}
    for result in results:
        if result["status"] != "ok" or result["stopped"] != "completed":
            sys.exit(f"pressure.py: run {result['id']}: {result['status']}, {result.get('stopped')}; must be completed")
        runs.setdefault(CASES[result["id"] // len(STARTS)], []).append((result["distance"], result["swimming"]["cavities"]))
    figures = {}
    for case, all_of_case in runs.items():
        distances, cavities = zip(*all_of_case)
        figures[case] = statistics.mean(distances), statistics.stdev(distances) / len(distances)**0.5, statistics.mean(cavities)
    return figures


def main():
    if len(sys.argv) == 1:
        for request in requests():
            print(json.dumps(request))
        return
    with open(sys.argv[1]) as file:
        figures = table(json.loads(line) for line in file)
    with open("results/water/pressure.csv", "w") as file:
        print("gait,gravity,refinement,support,distance,standard_error,cavities", file=file)
        for case, (mean, error, cavities) in figures.items():
            print(*case, f"{mean:.5f}", f"{error:.5f}", f"{cavities:.4f}", sep=",", file=file)
    for gait, gravity in itertools.product(GAITS, GRAVITIES):
        cells = [f"{mean:.3f} ± {error:.3f}, {cavities:.2f}" for refinement in REFINEMENTS for support in SUPPORTS
                 for mean, error, cavities in [figures[gait, gravity, refinement, support]]]
        print(f"| {gait} | {gravity} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
