#!/usr/bin/env python3
"""Converts the one-frame records of the thesis scene (.npz) to the particles format of micro/*.json.

    python3 convert_one_frame.py SOURCE_FOLDER TARGET_FOLDER

Needs numpy only. Numbers are written with the fewest digits that give back the same 32-bit float.
"""
import json
import pathlib
import sys

import numpy as np

# Appendix A of the thesis under the names of NVIDIA Flex; gravity is added per record.
PARAMETERS = {
    "numIterations": 4,
    "radius": 0.15, "solidRestDistance": 0.15, "fluidRestDistance": 0.1,
    "dynamicFriction": 0.2, "staticFriction": 0, "particleFriction": 0.2, "restitution": 0,
    "maxAcceleration": 100, "maxSpeed": float(np.finfo(np.float32).max),
    "damping": 1, "cohesion": 0, "viscosity": 8, "solidPressure": 0.1, "buoyancy": 1,
    "collisionDistance": 0.05, "particleCollisionMargin": 0, "shapeCollisionMargin": 0,
    "relaxationMode": 1, "relaxationFactor": 1,
    "planes": [[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [-1, 0, 0, 4.51], [0, 0, -1, 1.54]],
}
SUBSTEPS = 4
FRAME_SECONDS = 1 / 60
CLUSTER_STIFFNESS = 0.2
SPRING_STIFFNESS = 1


def number(value):
    """Shortest text that reads back as the same float32, without a trailing '.0'."""
    text = str(np.float32(value))
    return text[:-2] if text.endswith(".0") else text


def text(value):
    """JSON text of nested dicts, lists, arrays, strings and numbers, without spaces."""
    if isinstance(value, dict):
        return "{" + ",".join(json.dumps(key) + ":" + text(item) for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim > 0):
        return "[" + ",".join(map(text, value)) + "]"
    if isinstance(value, (np.float32, np.float64)):
        return number(value)
    if isinstance(value, np.integer):
        return str(int(value))
    return json.dumps(value)


def per_particle(swimmer_values, particles):
    """The swimmer comes first; particles that are in no cluster get zeros, which nobody reads."""
    padded = np.zeros((particles, 3), np.float32)
    padded[:len(swimmer_values)] = swimmer_values
    return padded


def experiment(name, record):
    particles = len(record["pos0"])
    offsets, members = record["cluster_offsets"], record["cluster_indices"]
    clusters = [members[begin:end] for begin, end in zip(offsets[:-1], offsets[1:])]
    gravity = [0, -10, 0] if "fluid" in name else [0, 0, 0]
    return {
        "name": name,
        "dt": FRAME_SECONDS,
        "substeps": SUBSTEPS,
        "params": {**PARAMETERS, "gravity": gravity},
        "pos": record["pos0"],
        "invm": record["invm"],
        "vel": record["vel0"],
        "phase": record["phase"],
        "springs": {
            "idx": record["springs"],
            "l0": record["rest_length"],
            "k": [SPRING_STIFFNESS] * len(record["springs"]),
        },
        "rigids": {
            "clusters": clusters,
            "rest": per_particle(record["rest_pos"], particles),
            "stiff": [CLUSTER_STIFFNESS] * len(clusters),
            "rot": record["rot0"],
            "trans": record["centre0"],
        },
        "frames": [{
            "frame": 1,
            "pos": record["pos1"],
            "vel": record["vel1"],
            "density": record["density1"],
            "rot": record["rot1"],
            "trans": record["centre1"],
            "first_substep": {"predicted": record["predicted"], "iterations": record["iterations"]},
        }],
    }


def main(source, target):
    for path in sorted(pathlib.Path(source).glob("*.npz")):
        with np.load(path) as record:
            converted = text([experiment(path.stem, record)])
        (pathlib.Path(target) / (path.stem + ".json")).write_text(converted + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
