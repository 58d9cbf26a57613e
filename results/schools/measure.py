#!/usr/bin/env python3
"""Swims of loaches in streets, rows and pairs: `measure.py KIND... [--jobs N] [--backend B]` appends a row a swim to KIND.jsonl in this folder. Kinds: street, pair, row, wake, frame; with
"-step" half the time step, with "-cells" half the cells and half the step. All swim in plane flow in a current of -x with the head to +x, by gait.json, which evolved in this scene."""
import argparse
import concurrent.futures
import json
import math
import pathlib
import time

import natator
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
GAIT = json.loads((HERE / "gait.json").read_text())
BEAT, LENGTH, CELL = 1 / GAIT["frequency"], 0.98, 0.02
FRAMES = 3  # between two commands of the pilot, 1/60 s each
GAIN = (0.2, 0.15, 0.1, 0.1)
FIRM = (0.4, 0.3, 0.1, 0.1)  # of pairs, which leave each other's wake by GAIN; chosen on three of them
SPEED, DRIVE = 1.0, 0.75  # of the current; the part of its amplitudes by which the loach goes about as fast
DRIVES = {(1, 1): DRIVE, (1, 2): 0.95, (2, 1): 0.99}  # the same by cells and steps so many times as fine, of streets without a cylinder


def loach(x, z, n):
    return {"name": "loach", "particleMass": 1, "rearCentre": [x, 0.01, z], **({"refinement": n} if n > 1 else {})}


def scene(size, rear, current=0.0, n=1, steps=1, periodic=(), **more):
    """A tank of so many units along x and z, with cells and steps so many times as fine; a wall slips unless it is periodic, or open to a current."""
    count = [round(size[0] / CELL) * n, 1, round(size[1] / CELL) * n]
    fluid = {"count": count, "spacing": CELL / n, "origin": [CELL / n / 2, 0.01, CELL / n / 2], "mass": {"bottom": 1 / n ** 2, "top": 1 / n ** 2}}
    if current:
        fluid["current"] = [-current, 0, 0]
    ends = {"x": [[1, 0, 0, 0], [-1, 0, 0, size[0]]], "z": [[0, 0, 1, 0], [0, 0, -1, size[1]]]}
    solver = {"substeps": 24 * n * steps}
    if n > 1:
        solver |= {"radius": 0.03 / n, "solidRestDistance": 0.02 / n, "fluidRestDistance": 0.02 / n, "collisionDistance": 0.04 / n}
    return {"movingTank": None, "planes": [plane for axis in periodic for plane in ends[axis]], "fluid": fluid, "solver": solver, "creature": loach(*rear, n),
            "stopping": {"planeContact": False, "noProgressAfter": 0}, **({"periodic": list(periodic)} if periodic else {}), **more}


class Pilot:
    """Steers a swimmer by means over a beat: its heading to a line along x, and if `station` is a place along x its drive to that."""

    def __init__(self, stream, z, station=None, drive=DRIVE, gain=GAIN, senses=None):
        self.stream, self.z, self.station, self.drive, self.gain = stream, z, station, drive, gain
        self.senses, self.window, self.sum, self.offset, self.lean = senses or stream.sense(), [], 0.0, 0.0, 0.0
        self.rows = []

    def command(self, rest=False):
        """Scales and offsets of the gait for the next frames."""
        s = self.senses
        self.window = [*self.window, (s.centre[0], s.centre[2], math.atan2(s.forward[2], s.forward[0]))][-round(BEAT * 60 / FRAMES):]
        x, z, heading = np.mean(self.window, axis=0)
        old = self.window[0]
        speed = (s.centre[0] - old[0]) / max(1, len(self.window) - 1) / (FRAMES / 60)
        aside = (s.centre[2] - old[1]) / max(1, len(self.window) - 1) / (FRAMES / 60)
        wanted = float(np.clip(-self.gain[0] * (z - self.z) - self.gain[1] * aside, -0.2, 0.2))
        self.lean = float(np.clip(self.lean + self.gain[3] * (heading - wanted) * FRAMES / 60, -0.1, 0.1))
        self.offset += float(np.clip(np.clip(self.gain[2] * (heading - wanted) + self.lean, -0.15, 0.15) - self.offset, -0.02, 0.02))
        scale = self.drive
        if self.station is not None:
            error = self.station - x
            self.sum = float(np.clip(self.sum + 0.15 * error * FRAMES / 60, -1, 1))
            scale = float(np.clip(self.drive + self.sum + 0.6 * error - 0.5 * speed, 0, 2.2))
        self.told = scale, heading
        actuators = self.stream.actuators
        if rest:
            return [0] * actuators, [0] * actuators
        return [min(scale, (2 - abs(self.offset)) / a) for a in GAIT["amplitude"]], [self.offset] * actuators

    def take(self, senses):
        """What it sees after them."""
        self.senses = senses
        self.rows.append(tuple(map(float, (senses.time, senses.centre[0], senses.centre[2], senses.work, *self.told))))

    def step(self, **more):
        scale, offset = self.command(**more)
        self.take(self.stream.step(FRAMES, scale=scale, offset=offset))

    def swim(self, seconds, **more):
        for _ in range(round(seconds * 60 / FRAMES)):
            self.step(**more)

    def of(self, begin, end):
        """Means from begin to end, s: speed over ground, work per time, scale, place and its spread."""
        rows = np.array([row for row in self.rows if begin - 1e-6 <= row[0] <= end + 1e-6])
        time = rows[-1, 0] - rows[0, 0]
        return {"speed": (rows[-1, 1] - rows[0, 1]) / time, "power": (rows[-1, 3] - rows[0, 3]) / time, "scale": rows[:, 4].mean(), "x": rows[:, 1].mean(),
                "z": rows[:, 2].mean(), "sd_x": rows[:, 1].std(), "sd_z": rows[:, 2].std(), "sd_heading": rows[:, 5].std()}


def beats(pilot, begin, end):
    """Speed over ground and work per time, beat by beat."""
    rows = np.array(pilot.rows)
    ends = np.arange(begin, end + 1e-6, BEAT)
    x, work = (np.interp(ends, rows[:, 0], rows[:, k]) for k in (1, 3))
    return {"speeds": (np.diff(x) / BEAT).round(4).tolist(), "powers": (np.diff(work) / BEAT).round(1).tolist()}


def shot(stream, name):
    """Keeps the vorticity, 1/s, and where bodies are, for a picture."""
    water = stream.water()
    bodies = [stream.scene["body"], *(one["body"] for one in stream.scene["companions"])]
    curl = water.vorticity()[:, 0, :, 1]
    np.savez_compressed(OUTPUT / f"{name}.npz", curl=curl.astype(np.float16), cell=water.cell, bodies=np.array([stream.frame.position[body][:, [0, 2]] for body in bodies]))


def street(diameter, behind, current, start, n, steps, backend, seconds=17.5, size=(5.4, 4.0), cylinder=4.6):
    """Holds station with the head `behind` units behind a cylinder, then rests for a second and a half; diameter 0: no cylinder."""
    x = cylinder - diameter / 2 - behind - LENGTH
    obstacles = {"obstacles": [{"shape": "sphere", "centre": [cylinder, 0.01, size[1] / 2 + 0.013], "radius": diameter / 2, "spacing": CELL / n}]} if diameter else {}
    with natator.Stream("plane/loach", gait=GAIT, start=start, backend=backend, fields=("position",), overrides=scene(size, (x, size[1] / 2), current, n, steps, **obstacles)) as stream:
        pilot = Pilot(stream, size[1] / 2, x + LENGTH / 2)
        try:
            pilot.swim(seconds)
            row = pilot.of(9, seconds) | beats(pilot, 9, seconds)
            if start == 1 and n == steps == 1:
                shot(stream, f"street-{diameter}-{behind}")
            pilot.swim(1.5, rest=True)
        except natator.Unstable as error:
            end = pilot.rows[-1][0]
            row = (pilot.of(9, end) | beats(pilot, 9, end) if end > 12 else {}) | {"unstable": str(error)}
        rest = np.array(pilot.rows)[-round(1.5 * 60 / FRAMES) - 1:, 1]
        return row | {"coasting": float(rest[-1] - rest[0]), "trail": [[round(v, 3) for v in r] for r in pilot.rows[::5]]}


def row(width, kind, current, start, n, steps, backend, seconds=10):
    """One of an endless row side by side, so far from each other: `same` phase, or `opposite`, mirrored by walls that slip."""
    size = (4.6, width)
    periodic = ("z",) if kind == "same" else ()
    with natator.Stream("plane/loach", gait=GAIT, start=start, backend=backend, overrides=scene(size, (2.6, width / 2), current, n, steps, periodic)) as stream:
        pilot = Pilot(stream, width / 2)
        pilot.swim(seconds)
        return pilot.of(4, seconds) | beats(pilot, 4, seconds)


def pair(gap, phase, current, start, n, steps, backend, seconds=12.0, size=(5.6, 3.2)):
    """Two behind each other, so far from tail to head, both steered along the middle; the leader beats `phase` beats later. Measured from 4 s on; `apart`: time, and how far the leader is before the follower and aside."""
    z, rear = size[1] / 2, 2.0
    company = {"companions": [{"creature": loach(rear + LENGTH + gap, z, n), "gait": GAIT | {"phase": [(p - phase) % 1 for p in GAIT["phase"]]}}]}
    with natator.Stream("plane/loach", gait=GAIT, start=start, backend=backend, fields=("position",), overrides=scene(size, (rear, z), current, n, steps, **company)) as stream:
        senses = stream.sense()
        pilots = [Pilot(stream, z, drive=DRIVES[n, steps], gain=FIRM, senses=one) for one in (senses, *senses.companions)]
        row = {}
        try:
            for _ in range(round(seconds * 60 / FRAMES)):
                commands = [pilot.command() for pilot in pilots]
                senses = stream.step(FRAMES, scale=[v for scale, _ in commands for v in scale], offset=[v for _, offset in commands for v in offset])
                for pilot, one in zip(pilots, (senses, *senses.companions)):
                    pilot.take(one)
        except natator.Unstable as error:
            row = {"unstable": str(error)}
        follower, leader = (np.array(pilot.rows) for pilot in pilots)
        if phase == 0 and start == 1 and n == steps == 1:
            shot(stream, f"pair-{gap}-follower")
        end = follower[-1, 0]
        if end > 6:
            row |= pilots[0].of(4, end) | {"leader": pilots[1].of(4, end)}
        trail = [[round(float(v), 4) for v in (f[0], l[1] - f[1], l[2] - f[2])] for f, l in zip(follower[::10], leader[::10])]
        return row | {"apart": trail}


def wake(start, n, steps, backend, current, seconds=19.0):
    """What is behind a swimmer in a tank fourteen lengths long, mean over the last 8 beats: squares of vorticity and of velocity across, over z."""
    size = (13.6, 2.4)
    with natator.Stream("plane/loach", gait=GAIT, start=start, backend=backend, fields=("position",), overrides=scene(size, (12.2, 1.2), current, n, steps)) as stream:
        pilot = Pilot(stream, 1.2, 12.2 + LENGTH / 2, DRIVE)
        pilot.swim(seconds - 8 * BEAT)
        curl, across, along, peaks = [], [], [], []
        frames = round(8 * BEAT * 60 / FRAMES)
        for k in range(frames):
            pilot.step()
            if k % 3 == 0:
                water = stream.water()
                v = water.velocity[:, 0]
                w = water.vorticity()[:, 0, :, 1]
                curl.append((w ** 2).mean(axis=1)), across.append((v[..., 2] ** 2).mean(axis=1)), along.append(v[..., 0].mean(axis=1)), peaks.append(np.abs(w).max(axis=1))
        if start == 1 and n == steps == 1:
            shot(stream, "wake")
        x = water.centres(0)
        tail = pilot.rows[-1][1] - LENGTH / 2
        at = {b: np.abs(x - (tail - b * LENGTH)).argmin() for b in (0.5, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11)}
        half = round(0.25 / (CELL / n))
        mean = {b: {"curl": float(np.mean([c[i - half:i + half].mean() for c in curl])) ** 0.5, "across": float(np.mean([c[i - half:i + half].mean() for c in across])) ** 0.5,
                    "peak": float(np.mean([c[i - half:i + half].max() for c in peaks]))} for b, i in at.items()}
        return pilot.of(seconds - 8 * BEAT, seconds) | beats(pilot, seconds - 8 * BEAT, seconds) | {"behind": mean}


OUTPUT = HERE
def frame(current, start, n, steps, backend):
    """The same swim, not steered and with all of its amplitudes, in a current: its speed through the water, beat by beat."""
    with natator.Stream("plane/loach", gait=GAIT, start=start, backend=backend, overrides=scene((6.0, 2.4), (0.6 + 2 * current, 1.2), current, n, steps)) as stream:
        rows = [(0.0, stream.sense().centre[0], 0.0)]
        for _ in range(round(3.5 * 60 / FRAMES)):
            senses = stream.step(FRAMES)
            rows.append((senses.time, senses.centre[0], senses.work))
        ends = np.arange(1.45, 3.5, BEAT)
        x, work = (np.interp(ends, *np.array(rows).T[[0, k]]) for k in (1, 2))
        return {"speeds": (np.diff(x) / BEAT + current).round(4).tolist(), "powers": (np.diff(work) / BEAT).round(1).tolist()}


FUNCTIONS = {"frame": frame, "street": street, "row": row, "pair": pair, "wake": wake}


def plans(kind):
    """Arguments of the swims of a kind."""
    base, _, finer = kind.partition("-")
    n, steps = {"": (1, 1), "step": (1, 2), "cells": (2, 1)}[finer]
    fine = {"n": n, "steps": steps}
    if base == "street":
        places = ((0, 1.5), (0.3, 1.0), (0.3, 1.5), (0.3, 2.5), (0.5, 2.0))
        return [{"diameter": d, "behind": b, "current": SPEED, "start": s, **fine} for s in range(1, 9 if n == 1 else 5) for d, b in (places[:3] if finer else places)]
    if base == "frame":
        return [{"current": c, "start": 1, **fine} for c in (0.0, 0.6, 1.2)]
    if base == "row":
        ways = [("opposite", w) for w in (0.4, 0.6, 0.8, 1.2, 1.6, 2.4)] + [("same", w) for w in (1.2, 1.6, 2.4)]
        return [{"width": w, "kind": k, "current": SPEED, "start": s, **fine} for k, w in (ways if not finer else [("opposite", 0.6), ("opposite", 2.4)]) for s in (1, 2)]
    if base == "pair":
        return [{"gap": g, "phase": p, "current": SPEED, "start": s, **fine} for s in ((1, 2) if not finer else (1,)) for g in (0.16, 0.3, 0.44, 0.58, 0.84)[::n] for p in (0, 0.25, 0.5, 0.75)]
    return [{"start": s, "current": SPEED, **fine} for s in (1, 2)]


def measured(kind, plan, backend):
    try:
        began = time.monotonic()
        row = plan | FUNCTIONS[kind.partition("-")[0]](**plan, backend=backend)
        return row | {"seconds": round(time.monotonic() - began, 1)}
    except natator.Unstable as error:
        return plan | {"unstable": str(error)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kinds", nargs="+")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--backend", default="cpu")
    parser.add_argument("--output-dir", type=pathlib.Path, default=HERE)
    parser.add_argument("--only", type=json.loads, default={}, help="JSON: keys that a swim must have to be made")
    options = parser.parse_args()
    global OUTPUT
    OUTPUT = options.output_dir
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        todo = {}
        for kind in options.kinds:
            for plan in plans(kind):
                if options.only.items() <= plan.items():
                    todo[pool.submit(measured, kind, plan, options.backend)] = kind
        for future in concurrent.futures.as_completed(todo):
            with open(options.output_dir / f"{todo[future]}.jsonl", "a", encoding="utf-8") as file:
                print(json.dumps({k: round(v, 5) if isinstance(v, float) else v for k, v in future.result().items()}), file=file)


if __name__ == "__main__":
    main()
