#!/usr/bin/env python3
"""Scheme `lattice` under stress: one thing made worse at a time, in a plane and in a small lake, 1 s each, into lattice.csv.

    NATATOR_SIM=build/release/bin/natator-sim python3 results/stability/lattice.py > results/stability/lattice.csv"""
import csv
import json
import os
import subprocess
import sys

LOACH = {"frequency": 2, "amplitude": [0.4, 0.35, 0.3, 0.25, 0.2], "phase": [0, 0.902, 0.804, 0.706, 0.608]}
WAVE = {"frequency": 2, "amplitude": [0.07, 0.12, 0.17, 0.22, 0.27, 0.32, 0.37, 0.42], "phase": [0, 0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 0.65]}
LAKE = {"movingTank": {"along": "x", "step": 0.15}, "creature": {"rearCentre": [0.72, 0.6, 0.6]}, "fluid": {"count": [76, 32, 32]},
        "planes": [[0, 1, 0, 0], [1, 0, 0, 0], [-1, 0, 0, 2.85], [0, 0, 1, 0], [0, 0, -1, 1.2]]}
SCENES = {"plane/loach": (LOACH, {}, 1), "lake/creature-2": (WAVE, LAKE, 0.421875)}  # gait, changes, mass of a particle as heavy as its water
AXES = {"dt": (0.25, 0.5, 1, 2, 3, 4, 8, 16, 32), "substeps": (1, 2, 4, 8, 12, 24, 48), "iterations": (1, 2, 8, 64), "mass-ratio": (1e-3, 0.01, 0.1, 0.3, 1, 3, 10, 100, 1e4),
        "stiffness": (0, 0.01, 0.1, 0.5, 0.9, 1), "frequency": (0.5, 2, 4, 8, 15, 30, 60), "amplitude": (0, 0.5, 1, 1.5, 2), "gravity": (0, 1, 10, 100),
        "viscosity": (0, 1e-6, 1e-4, 0.002, 0.02, 0.2, 2)}


def changes(axis, value, mass):
    """Overrides of the scene, and of its gait."""
    return {"dt": lambda: ({"timeStep": value / 60}, {}), "substeps": lambda: ({"solver": {"substeps": value}}, {}),
            "iterations": lambda: ({"solver": {"solidIterations": value}}, {}), "mass-ratio": lambda: ({"creature": {"particleMass": mass * value}}, {}),
            "stiffness": lambda: ({"creature": {"clusterStiffness": value, "springStiffness": value}}, {}),
            "frequency": lambda: ({}, {"frequency": value}), "amplitude": lambda: ({}, {"amplitude": value}), "gravity": lambda: ({"solver": {"gravity": [0, -value, 0]}}, {}),
            "viscosity": lambda: ({"solver": {"kinematicViscosity": value}}, {})}[axis]()


def merged(into, change):
    return {**into, **{key: merged(into[key], one) if isinstance(one, dict) and isinstance(into.get(key), dict) else one for key, one in change.items()}}


def main():
    asked = []
    for scene, (gait, lake, mass) in SCENES.items():
        for axis, values in AXES.items():
            for value in values:
                change, other = changes(axis, value, mass)
                own = {**gait, **other}
                if axis == "amplitude":
                    own["amplitude"] = [value] * len(gait["amplitude"])
                overrides = merged(merged(lake, change), {"stopping": {"planeContact": False, "noProgressAfter": 0}})
                asked.append((scene, axis, value, {"id": len(asked), "scene": scene, "duration": 1, "gait": own, "overrides": overrides}))
    done = subprocess.run([os.environ["NATATOR_SIM"], "serve"], input="".join(json.dumps(one[-1]) + "\n" for one in asked), capture_output=True, text=True, check=True)
    found = {one["id"]: one for one in map(json.loads, done.stdout.splitlines())}
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(["scene", "axis", "value", "status", "why", "seconds", "distance"])
    for scene, axis, value, request in asked:
        one = found[request["id"]]
        bad = one.get("unstable") or {}
        why = one.get("error", "").split(": ", 1)[-1] if one["status"] == "error" else bad.get("law", "") if one["status"] == "unstable" else ""
        rows.writerow([scene, axis, value, one["status"], why, one.get("simulated", ""), one.get("distance", "")])


main()
