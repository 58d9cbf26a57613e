#!/usr/bin/env python3
"""Soft bodies in lakes under finer cells and steps: `soft.py requests` writes what `natator-sim serve` is to compute, `soft.py keep` what is kept of its
answers, `soft.py table FILE` shows those. Each gait beats at f and is a wave of w lengths that runs to the tail, muscles driven from `first` at the head to `last` at the tail."""
import json
import sys

GAITS = {
    "creature-2": (8, [(2, 0.07, 0.42, 0.35), (2, 0.07, 0.42, 0.56), (2, 0.07, 0.42, 1.0), (2, 0.1, 0.6, 0.35), (1.5, 0.1, 0.6, 0.7), (2.5, 0.07, 0.4, 0.35)]),
    "eel": (8, [(2, 0.07, 0.42, 0.35), (2, 0.07, 0.42, 0.7), (2, 0.1, 0.6, 0.35), (1.5, 0.1, 0.6, 0.7), (2.5, 0.07, 0.4, 0.35), (2, 0.3, 0.3, 0.5)]),
    "fry": (7, [(2, 0.3, 0.3, 0.5), (2, 0.03, 0.3, 0.5), (2, 0.05, 0.5, 0.8), (2, 0.3, 0.3, 0.8), (2, 0.15, 0.15, 0.5), (3, 0.03, 0.3, 0.8)]),
}
LEVELS = {"cells": (1, 24), "half the step": (1, 48), "cells / 1.5": (1.5, 36), "cells / 2": (2, 48)}
STARTS = 2


def gait(actuators, f, first, last, waves):
    along = [k / (actuators - 1) for k in range(actuators)]
    return {"frequency": f, "amplitude": [round(first + (last - first) * s, 4) for s in along], "phase": [round(-waves * s % 1, 6) for s in along]}


def level(finer, substeps):
    cell = 0.0375 / finer
    return {"duration": 2, "stopping": {"noProgressAfter": 0, "planeContact": False}, "solver": {"substeps": substeps},
            "fluid": {"count": [round(n * finer) for n in (120, 48, 48)], "spacing": cell, "origin": [cell / 2] * 3, "mass": {"bottom": 1000 * cell ** 3}}}


def number(body, gait_number, name, start):
    return 1000 * list(GAITS).index(body) + 100 * gait_number + 10 * list(LEVELS).index(name) + start


def requests():
    for body, (actuators, gaits) in GAITS.items():
        for name, how in LEVELS.items():
            for k, one in enumerate(gaits):
                for start in range(1, STARTS + 1):
                    yield {"id": number(body, k, name, start), "scene": f"lake/{body}", "overrides": level(*how), "gait": gait(actuators, *one), "start": start}


def keep():
    for line in sys.stdin:
        one = json.loads(line)
        swim = one.get("swimming", {})
        print(json.dumps({key: one.get(key) for key in ("id", "status", "distance")} | {key: swim.get(key) for key in ("reynolds", "strouhal")}))


def table(path):
    results = {one["id"]: one for one in map(json.loads, open(path))}
    print("| body, f, first, last, waves | " + " | ".join(LEVELS) + " | Reynolds, Strouhal |\n| --- " + "| ---: " * (len(LEVELS) + 1) + "|")
    for body, (_, gaits) in GAITS.items():
        for k, one in enumerate(gaits):
            cells = []
            for name in LEVELS:
                found = [results.get(number(body, k, name, start), {}) for start in range(1, STARTS + 1)]
                way = [r["distance"] for r in found if r.get("status") == "ok"]
                cells.append(f"{sum(way) / len(way):.3f} ± {(max(way) - min(way)) / 2:.3f}" if len(way) == STARTS else "unstable")
            print(f"| {body}, " + ", ".join(map(str, one)) + " | " + " | ".join(cells) + f" | {found[0]['reynolds']:.0f}, {found[0]['strouhal']:.2g} |")


if __name__ == "__main__":
    if sys.argv[1:] == ["requests"]:
        for one in requests():
            print(json.dumps(one))
    elif sys.argv[1:] == ["keep"]:
        keep()
    elif len(sys.argv) == 3 and sys.argv[1] == "table":
        table(sys.argv[2])
    else:
        sys.exit("usage: soft.py requests | soft.py keep | soft.py table FILE")
