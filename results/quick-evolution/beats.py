"""Strouhal numbers of the loach by the speed of the same last three beats as the tail's amplitude, beside those by the mean speed from rest."""
import json
import pathlib

import natator
import numpy as np

HERE = pathlib.Path(__file__).parent
SECONDS, BEATS = 4, 3


def swim(gait, **creature):
    """Speed, its part in the last beats, body lengths/s; Strouhal number by either."""
    with natator.Stream("plane/loach", gait=gait, overrides={"creature": creature}, fields=("position",)) as stream:
        scene, step = stream.scene, stream.scene["definition"]["movingTank"]["step"]
        tail, x, here = [0.0], [0.0], stream.frame.position[scene["slices"][-1], 2].mean(dtype=float)
        for _ in range(round(SECONDS / scene["timeStep"])):
            x.append(stream.step().distance)
            before, here = here, stream.frame.position[scene["slices"][-1], 2].mean(dtype=float)
            tail.append(tail[-1] + here - before - step * round((here - before) / step))  # over ground
    frames, beat = np.arange(len(x)), 1 / gait["frequency"] / scene["timeStep"]
    amplitude = 0
    for k in range(BEATS):
        ends = frames[-1] - np.array([k + 1, k]) * beat
        inside = np.arange(np.ceil(ends[0]), np.floor(ends[1]) + 1)
        left = np.append(np.interp(inside, frames, tail) - np.interp(inside, ends, np.interp(ends, frames, tail)), 0)
        amplitude += np.ptp(left) / BEATS
    mean = x[-1] / SECONDS
    last = (x[-1] - np.interp(frames[-1] - BEATS * beat, frames, x)) / (BEATS / gait["frequency"])
    swing, length = gait["frequency"] * amplitude, scene["bodyLength"]
    return mean / length, last / length, swing / mean, swing / last


def main():
    gaits = {f"seed {seed}": json.loads((HERE / f"loach-seed-{seed}/best.json").read_text())["gait"] for seed in (1, 2, 3)}
    gaits["by hand"] = {key: value for key, value in json.loads((HERE / "../../sim-native/examples/gaits/loach.json").read_text()).items() if key != "$schema"}
    for name, gait in gaits.items():
        print(name, *(f"{value:.2f}" for value in swim(gait)))
    for creature in ({"clusterStiffness": 0.9}, {"springStiffness": 0.9}, {"clusterStiffness": 0.95, "springStiffness": 0.8}):
        print("by hand,", creature, *(f"{value:.2f}" for value in swim(gaits["by hand"], **creature)))


main()
