#!/usr/bin/env python3
"""How far the open-water creatures bend in vacuum under a travelling wave, by time step, iterations, stiffness and spacing.

usage: bending.py SIMULATOR OUTPUT.csv [JOBS]

Bending: range of the angle between the body's axis at the tail and at the head, over the beat before 2.7 s, degrees.
"""
import concurrent.futures
import csv
import json
import math
import subprocess
import sys
import tempfile

# amplitude and phase by actuator; 1.5 beats a second
GAITS = {
    1: ([0.5, 0.5], [0, 0.6]),
    2: ([0.1, 0.17, 0.24, 0.31, 0.38, 0.45, 0.52, 0.6], [0, 0.862, 0.724, 0.586, 0.448, 0.31, 0.172, 0.034]),
    3: ([0.2, 0.3, 0.4, 0.5, 0.6], [0, 0.85, 0.7, 0.55, 0.4]),
    4: ([0.4, 0.5, 0.6], [0, 0.75, 0.5]),
}
FRAMES_OF_A_BEAT = 40


def bending(simulator, creature, cluster, spring, refinement, substeps, iterations):
    overrides = {
        "fluid": None, "planes": [],
        "solver": {"substeps": substeps, "numIterations": iterations, "solidIterations": 1, "gravity": [0, 0, 0]},
        "creature": {"clusterStiffness": cluster, "springStiffness": spring, "refinement": refinement},
        "stopping": {"planeContact": False, "noProgressAfter": 0},
    }
    amplitude, phase = GAITS[creature]
    with tempfile.NamedTemporaryFile(suffix=".csv") as path:
        subprocess.run([simulator, "run", f"open-water/creature-{creature}", "--duration", "2.7", "--no-cache",
                        "--gait", json.dumps({"frequency": 1.5, "amplitude": amplitude, "phase": phase}),
                        "--overrides", json.dumps(overrides), "--trajectory", path.name],
                       check=True, stdout=subprocess.DEVNULL)
        frames = {}
        with open(path.name, newline="") as file:
            for row in csv.DictReader(file):
                frames.setdefault(int(row["frame"]), []).append((float(row["x"]), float(row["z"])))

    def heading(slices, front, rear):
        return math.atan2(slices[rear][1] - slices[front][1], slices[front][0] - slices[rear][0])

    angles = [heading(slices, -3, -1) - heading(slices, 0, 2) for slices in frames.values()][-FRAMES_OF_A_BEAT - 1:]
    return math.degrees(max(angles) - min(angles))


def main():
    simulator, output = sys.argv[1:3]
    steps = [(4, 8), (4, 64), (8, 8), (16, 8), (32, 8), (8, 32), (32, 32)]
    cases = [(creature, cluster, spring, 1, *step) for creature in GAITS
             for cluster, spring in ((0.6, 0.4), (0.9, 1), (0.2, 1)) for step in steps]
    cases += [(creature, 0.6, 0.4, 2, *step) for creature in GAITS for step in ((4, 64), (8, 8), (16, 8), (8, 32))]
    with concurrent.futures.ThreadPoolExecutor(int(sys.argv[3]) if len(sys.argv) > 3 else 1) as pool:
        degrees = pool.map(lambda case: bending(simulator, *case), cases)
        with open(output, "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["creature", "cluster_stiffness", "spring_stiffness", "refinement", "substeps", "iterations",
                             "bending_degrees"])
            for case, angle in zip(cases, degrees):
                writer.writerow([*case, f"{angle:.1f}"])


if __name__ == "__main__":
    main()
