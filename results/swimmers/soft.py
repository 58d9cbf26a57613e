#!/usr/bin/env python3
"""Soft bodies in lakes under finer cells and steps: `soft.py requests [BODY]...` writes what `natator-sim serve` is to compute, `soft.py keep` what is kept
of its answers, `soft.py table FILE` shows those. Each gait beats at f and is a wave of w lengths that runs to the tail, muscles driven from `first` at the head to `last` at the tail."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from lakes import lake  # noqa: E402

THICK = [(2, 0.07, 0.42, 0.35), (2, 0.07, 0.42, 0.56), (2, 0.07, 0.42, 1.0), (2, 0.1, 0.6, 0.35), (1.5, 0.1, 0.6, 0.7), (2.5, 0.07, 0.4, 0.35)]
FISH = [(2, *drive, waves) for drive in ((0.3, 0.3), (0.03, 0.3), (0.05, 0.5), (0.15, 0.15), (0.1, 0.2)) for waves in (0.5, 0.65, 0.8)]
FISH += [(3, 0.03, 0.3, waves) for waves in (0.5, 0.65, 0.8)]
BODIES = {"creature-2": (8, 0.025, THICK), "eel": (8, 0.025, THICK), "fry": (7, 0.01875, FISH), "fry, fine": (7, 0.0125, FISH)}  # actuators, cells, gaits
LEVELS = {"cells": (1, 1, 2), "half the step": (1, 2, 2), "cells / 2": (2, 2, 1)}  # cells and steps, of a cell, so many times as fine; starts
BOX = (3.0, 1.35, 1.35)


def gait(actuators, f, first, last, waves):
    along = [k / (actuators - 1) for k in range(actuators)]
    return {"frequency": f, "amplitude": [round(first + (last - first) * s, 4) for s in along], "phase": [round(-waves * s % 1, 6) for s in along]}


def number(body, gait_number, name, start):
    return 1000 * list(BODIES).index(body) + 50 * gait_number + 10 * list(LEVELS).index(name) + start


def requests(bodies):
    for body in bodies:
        actuators, cell, gaits = BODIES[body]
        for name, (finer, steps, starts) in LEVELS.items():
            for k, one in enumerate(gaits):
                for start in range(1, starts + 1):
                    yield {"id": number(body, k, name, start), "scene": "lake/" + body.removesuffix(", fine"), "overrides": lake(BOX, cell / finer, BOX[0] / 4, steps // finer),
                           "gait": gait(actuators, *one), "start": start}


def keep():
    for line in sys.stdin:
        one = json.loads(line)
        swim = one.get("swimming", {})
        print(json.dumps({key: one.get(key) for key in ("id", "status", "distance")} | {key: swim.get(key) for key in ("reynolds", "strouhal")}))


def table(path):
    results = {one["id"]: one for one in map(json.loads, open(path))}
    print("| body, f, first, last, waves | " + " | ".join(LEVELS) + " | change at half the cells, the step | Reynolds, Strouhal |\n|---" + "|---:" * (len(LEVELS) + 2) + "|")
    for body, (_, _, gaits) in BODIES.items():
        if number(body, 0, "cells", 1) not in results:
            continue
        changes = []
        for k, one in enumerate(gaits):
            means, cells = {}, []
            for name, (_, _, starts) in LEVELS.items():
                found = [results.get(number(body, k, name, start), {}) for start in range(1, starts + 1)]
                way = [r["distance"] for r in found if r.get("status") == "ok"]
                means[name] = sum(way) / len(way) if len(way) == starts else None
                spread = f" ± {(max(way) - min(way)) / 2:.3f}" if starts > 1 and means[name] is not None else ""
                cells.append("unstable" if means[name] is None else f"{means[name]:.3f}{spread}")
            base = means["cells"]
            changes.append([means[name] / base - 1 if base and means[name] is not None else float("inf") for name in ("cells / 2", "half the step")])
            print(f"| {body}, " + ", ".join(map(str, one)) + " | " + " | ".join(cells) + " | {:+.0%}, {:+.0%} | ".format(*changes[-1])
                  + f"{found[0].get('reynolds') or 0:.0f}, {found[0].get('strouhal') or 0:.2g} |")
        print(f"{body}: of {len(gaits)} gaits {sum(abs(c[0]) <= 0.05 for c in changes)} within 5 % at half the cells, "
              f"{sum(abs(c[1]) <= 0.03 for c in changes)} within 3 % at half the step", file=sys.stderr)


if __name__ == "__main__":
    if sys.argv[1:2] == ["requests"]:
        for one in sorted(requests(sys.argv[2:] or BODIES), key=lambda one: -one["overrides"]["fluid"]["count"][0]):
            print(json.dumps(one))
    elif sys.argv[1:] == ["keep"]:
        keep()
    elif len(sys.argv) == 3 and sys.argv[1] == "table":
        table(sys.argv[2])
    else:
        sys.exit("usage: soft.py requests [BODY]... | soft.py keep | soft.py table FILE")
