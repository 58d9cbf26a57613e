#!/usr/bin/env python3
"""Scheme `lattice` under stress: one thing made worse at a time, in a plane and in a small lake, 1 s each, into lattice.csv.

    NATATOR_SIM=build/release/bin/natator-sim python3 results/stability/lattice.py > results/stability/lattice.csv"""
import csv
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from lakes import answers, gait  # noqa: E402

LAKE = {"movingTank": {"along": "x", "step": 0.15}, "creature": {"rearCentre": [0.72, 0.6, 0.6]}, "fluid": {"count": [76, 32, 32]},
        "planes": [[0, 1, 0, 0], [1, 0, 0, 0], [-1, 0, 0, 2.85], [0, 0, 1, 0], [0, 0, -1, 1.2]]}
SCENES = {"plane/loach": ("loach", {}, 1), "lake/creature-2": ("fish-like", LAKE, 0.421875)}  # gait, changes, mass of a particle as heavy as its water
# Of each: the part of a scene, or of the gait, with what it becomes by a value and that mass; values.
AXES = {"dt": ("scene", lambda value, mass: {"timeStep": value / 60}, (0.25, 0.5, 1, 2, 3, 4, 8, 16, 32)),
        "substeps": ("solver", lambda value, mass: {"substeps": value}, (1, 2, 4, 8, 12, 24, 48)),
        "iterations": ("solver", lambda value, mass: {"solidIterations": value}, (1, 2, 8, 64)),
        "mass-ratio": ("creature", lambda value, mass: {"particleMass": mass * value}, (1e-3, 0.01, 0.1, 0.3, 1, 3, 10, 100, 1e4)),
        "stiffness": ("creature", lambda value, mass: {"clusterStiffness": value, "springStiffness": value}, (0, 0.01, 0.1, 0.5, 0.9, 1)),
        "frequency": ("gait", lambda value, mass: {"frequency": value}, (0.5, 2, 4, 8, 15, 30, 60)),
        "amplitude": ("gait", lambda value, mass: {"amplitude": value}, (0, 0.5, 1, 1.5, 2)),
        "gravity": ("solver", lambda value, mass: {"gravity": [0, -value, 0]}, (0, 1, 10, 100)),
        "viscosity": ("solver", lambda value, mass: {"kinematicViscosity": value}, (0, 1e-6, 1e-4, 0.002, 0.02, 0.2, 2))}


def request(number, scene, axis, value):
    name, changes, mass = SCENES[scene]
    part, change, _ = AXES[axis]
    own, change, overrides = gait(name), change(value, mass), {**changes, "stopping": {"planeContact": False, "noProgressAfter": 0}}
    if part == "gait":
        own |= {key: [one] * len(own[key]) if key == "amplitude" else one for key, one in change.items()}
    else:
        overrides |= change if part == "scene" else {part: {**overrides.get(part, {}), **change}}
    return {"id": number, "scene": scene, "duration": 1, "gait": own, "overrides": overrides}


def main():
    points = [(scene, axis, value) for scene in SCENES for axis, (*_, values) in AXES.items() for value in values]
    found = answers(request(number, *point) for number, point in enumerate(points))
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(["scene", "axis", "value", "status", "why", "seconds", "distance"])
    for number, point in enumerate(points):
        one = found[number]
        why = one.get("error", "").split(": ", 1)[-1] if one["status"] == "error" else (one.get("unstable") or {}).get("law", "")
        rows.writerow([*point, one["status"], why, one.get("simulated", ""), one.get("distance", "")])


main()
