#!/usr/bin/env python3
"""Random scenes inside the documented limits: what ends well must be possible. No particle may be behind a wall, none faster than
100 body lengths/s, and in scheme conserving all together may have no more energy than at the start and by the muscles' work.
Needs numpy. The same seed gives the same scenes; a faulty one is printed as a command that runs it again."""
import argparse
import collections
import concurrent.futures
import json
import math
import os
import pathlib
import random
import shlex
import subprocess
import sys
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "sim-native/python"))

import natator  # noqa: E402

LONGEST_SPEED = 100   # body lengths/s; without a body 60 units/s, or where that is more 6 times the speed of a fall from crowded water
ENERGY_NOISE = 0.1    # of the energy of a fall over the height of the water; as much again for its disorder
# What is drawn for a key of `solver`: (lowest, highest) on a logarithmic scale, both inside sim-native/protocol/scenes.md.
SOLVER = {
    "substeps": (1, 16), "numIterations": (1, 128), "solidIterations": (1, 16), "dynamicFriction": (1e-2, 100),
    "staticFriction": (1e-2, 100), "particleFriction": (1e-2, 100), "restitution": (1e-2, 1), "adhesion": (1e-1, 1e4),
    "sleepThreshold": (1e-3, 1), "maxSpeed": (1e-1, 1e3), "maxAcceleration": (1, 1e5), "shockPropagation": (1e-2, 10),
    "dissipation": (1e-2, 1e3), "damping": (1e-2, 1e3), "cohesion": (1e-3, 1e3), "surfaceTension": (1e-2, 1e4),
    "viscosity": (1e-1, 1e4), "kernelSupport": (2, 4), "kinematicViscosity": (1e-5, 1e-1), "vorticityConfinement": (1e-3, 1e3),
    "solidPressure": (1e-3, 100), "freeSurfaceDrag": (1e-1, 1e3), "buoyancy": (0.1, 10), "collisionDistance": (1e-3, 0.2),
    "particleCollisionMargin": (1e-3, 0.1), "shapeCollisionMargin": (1e-3, 0.1), "relaxationFactor": (1e-2, 10),
    "radius": (0.12, 0.3), "maxNeighborsPerParticle": (4, 200),
}
WHOLE = {"substeps", "numIterations", "solidIterations", "maxNeighborsPerParticle"}


def log_uniform(chance, low, high):
    return round(low * (high / low) ** chance.random(), 6)


def random_solver(chance):
    solver = {}
    for key in chance.sample(sorted(SOLVER), chance.choice((0, 1, 1, 2, 2, 3, 5))):
        value = log_uniform(chance, *SOLVER[key])
        solver[key] = round(value) if key in WHOLE else value
    if chance.random() < 0.2:
        solver["gravity"] = [round(chance.uniform(-10, 10), 2), -log_uniform(chance, 0.1, 300), round(chance.uniform(-5, 5), 2)]
    if chance.random() < 0.1:
        solver["gravity"] = [0, 0, 0]
    if chance.random() < 0.1:
        solver["relaxationMode"] = "global"
    return solver


def random_scene(chance, scheme):
    """A tank with water, a body or both, of at most some hundred particles."""
    count = [chance.randint(3, 12), chance.randint(2, 9), chance.randint(3, 9)]
    spacing = round(chance.choice((0.09, 0.1, chance.uniform(0.06, 0.14))), 4)
    size = [0.1 + spacing * (n - 1) + chance.choice((0, 0, chance.uniform(0, 2))) for n in count]
    planes = [[0, 1, 0, 0], [1, 0, 0, 0], [-1, 0, 0, size[0]], [0, 0, 1, 0], [0, 0, -1, size[2]]]
    if chance.random() < 0.2:
        planes.append([0, -1, 0, size[1] + chance.choice((0, 0.3))])
    scene = {
        "scheme": scheme, "duration": round(chance.uniform(0.1, 0.8), 3), "planes": planes, "solver": random_solver(chance),
        "settling": {"updates": chance.choice((0, 5, 20, 100)), "timeStep": chance.choice((1e-4, 1e-4, 1e-3))},
        "stopping": {"planeContact": False, "noProgressAfter": 0},
        "fluid": {"count": count, "spacing": spacing, "disorder": chance.randrange(1000),
                  "mass": {"gradient": chance.choice(("uniform", "mass-linear", "inverse-mass-linear")),
                           "bottom": log_uniform(chance, 0.02, 20), "top": log_uniform(chance, 0.02, 20)}},
    }
    if chance.random() < 0.3:
        scene["fluid"]["mass"]["bottom"] = log_uniform(chance, 1e-6, 1e6)
    if chance.random() < 0.2:
        scene["timeStep"] = log_uniform(chance, 1e-3, 0.2)
        scene["duration"] = round(max(scene["duration"], 4 * scene["timeStep"]), 3)
    actuators = 0
    if chance.random() < 0.6 and size[0] > 0.8 and size[2] > 0.4:
        joints, actuators = [2, 4, 6], 2
        scene["creature"] = {
            "slices": [{"height": chance.randint(2, 4), "width": chance.choice((2, 3)), "count": 9}], "joints": joints,
            "rearCentre": [round(chance.uniform(0.1, size[0] - 0.7), 3), round(chance.uniform(0.2, 0.6), 3), round(size[2] / 2, 3)],
            "particleMass": log_uniform(chance, 1e-2, 1e2) if chance.random() < 0.3 else 1,
            "clusterStiffness": chance.choice((0.05, 0.2, 0.6, 1)), "springStiffness": chance.choice((0.2, 1))}
        if chance.random() < 0.15 and actuators:
            del scene["fluid"]
    gait = None
    if actuators:
        gait = {"frequency": log_uniform(chance, 0.5, 60 if chance.random() < 0.1 else 2),
                "amplitude": [round(chance.random(), 3) for _ in range(actuators)],
                "phase": [round(chance.random(), 3) for _ in range(actuators)]}
    return scene, gait


def crowding_of(scene):
    """How many particles of water are where one has room."""
    return max(1, (0.1 / scene["fluid"]["spacing"]) ** 3) if "fluid" in scene else 1


def energy_noise(scene, begin, gravity):
    """What may be gained for each mass, (length/s)^2: noise of the pressure, the rise of crowded water to its rest density, the
    work of cohesion, without gravity of surface tension, and where there is no gravity what parting at 5 % a substep leaves in velocities."""
    solver, substeps = scene["solver"], scene["solver"].get("substeps", 4) / scene.get("timeStep", 1 / 60)
    pull = np.linalg.norm(gravity) * max(1, solver.get("buoyancy", 1))
    fall = (np.ptp(begin.position.astype(float) @ gravity) + 0.15 * np.linalg.norm(gravity)) * max(1, solver.get("buoyancy", 1))
    crowding = crowding_of(scene)
    parting = min(0.05 * substeps, 0.25 * math.sqrt(pull / 0.1) if pull else math.inf)
    radius = solver.get("radius", 0.15)
    forces = solver.get("cohesion", 0) * (240 * radius) ** 2 / 32 + (0 if pull else solver.get("surfaceTension", 0) / 2)
    size = 0.1 if crowding == 1 else np.linalg.norm(np.ptp(begin.position, axis=0))  # all of what is crowded comes apart at once
    return (ENERGY_NOISE + 1.2 * crowding - 1.1) * fall + forces + (size * parting) ** 2 / 2 + 1e-4


def fault_of(scene, stream, begin, work):
    """What is impossible in the stream's last frame; None if nothing is."""
    frame, solver = stream.frame, scene["solver"]
    gravity = np.array(solver.get("gravity", [0, -10, 0]), float)
    free = np.array([m is not None for m in stream.scene["mass"]])
    speed = np.sqrt(np.sum(frame.velocity.astype(float) ** 2, axis=1)).max()
    fall = (np.ptp(begin.position.astype(float) @ gravity) + 0.15 * np.linalg.norm(gravity)) * crowding_of(scene)
    longest = LONGEST_SPEED * stream.scene["bodyLength"] if "creature" in scene else max(60, 6 * math.sqrt(2 * fall))
    if not np.isfinite(speed) or speed > longest:
        return f"a particle has speed {speed:.4g}, more than {longest:.4g}"
    for plane in scene["planes"]:
        depth = -(frame.position[free].astype(float) @ plane[:3] + plane[3]).min()
        if depth > solver.get("radius", 0.15) + 1e-3:
            return f"a particle is {depth:.4g} behind plane {plane}"
    if scene["scheme"] != "conserving" or "shockPropagation" in solver:
        return None
    mass = np.array([m or 0 for m in stream.scene["mass"]])
    pull = np.where(stream.is_fluid, solver.get("buoyancy", 1), 1)[:, None] * gravity
    now, then = (np.sum(mass * (0.5 * np.sum(f.velocity.astype(float) ** 2, axis=1) - np.sum(f.position * pull, axis=1)))
                 for f in (frame, begin))
    allowed = mass.sum() * energy_noise(scene, begin, gravity)
    if now - then - max(work, 0) > allowed:
        return f"energy rose by {now - then:.4g}, the muscles did {work:.4g}, noise may do {allowed:.4g}"
    return None


def run(number, seed, scheme, program):
    """The outcome of a scene, the laws that it broke or what was refused, and a fault."""
    chance = random.Random(f"{seed}/{scheme}/{number}")
    scene, gait = random_scene(chance, scheme)
    overrides = {key: value for key, value in scene.items() if key != "scheme"}
    try:
        stream = natator.Stream(program.empty, gait=gait, overrides=overrides, scheme=scheme, fields=("position", "velocity"),
                                program=program.path)
    except natator.InputError as error:
        return "refused", str(error), None, scene, gait
    with stream:
        try:
            first, fluid = stream.scene["fluid"]
            stream.is_fluid = np.arange(stream.scene["particles"]) >= first
            stream.is_fluid &= np.arange(stream.scene["particles"]) < first + fluid
            begin = stream.frame
            stream.require_stable()
            frames = max(1, round(scene["duration"] / scene.get("timeStep", 1 / 60)))
            work = 0
            if "creature" in scene:
                senses = stream.step(frames)
                work = senses.work if senses.work == senses.work else 0
            else:
                stream.send({"do": "credit"})
                stream.send({"do": "step", "frames": frames})
                stream.receive(), stream.receive()
                stream.require_stable()
        except natator.Unstable as unstable:
            return "unstable", unstable.law, None, scene, gait
        return "ok", "", fault_of(scene, stream, begin, work), scene, gait


class Program:
    def __init__(self, path, folder):
        self.path = str(path)
        self.empty = str(folder / "empty.json")
        folder.mkdir(parents=True, exist_ok=True)
        pathlib.Path(self.empty).write_text("{}")


def on_gpu(scheme, options, program):
    """Outcomes on a GPU beside the CPU's, of whole evaluations. Those that are near a limit may differ, as last digits do."""
    same, other = collections.Counter(), []
    requests = []
    for number in range(options.first, options.first + options.scenes):
        scene, gait = random_scene(random.Random(f"{options.seed}/{scheme}/{number}"), scheme)
        requests.append({"id": number, "scene": program.empty, "overrides": {k: v for k, v in scene.items() if k != "scheme"},
                         "scheme": scheme} | ({"gait": gait} if gait else {}))
    answers = {}
    for backend, workers in (("cpu", options.jobs), ("cuda", 2)):
        lines = {k: [json.dumps(r) for r in requests[k::workers]] for k in range(workers)}
        def serve(k):
            done = subprocess.run([program.path, "serve", "--backend", backend], input="\n".join(lines[k]) + "\n", text=True,
                                  capture_output=True)
            return [json.loads(line) for line in done.stdout.splitlines()]
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            answers[backend] = {a["id"]: a for part in pool.map(serve, range(workers)) for a in part}
    for number, cpu in sorted(answers["cpu"].items()):
        gpu = answers["cuda"].get(number, {"status": "no answer"})
        verdicts = [a["status"] + " " + a.get("unstable", {}).get("law", "") for a in (cpu, gpu)]
        if verdicts[0] == verdicts[1]:
            same[verdicts[0]] += 1
        else:
            other.append((number, *verdicts))
    print(f"{scheme} on a GPU: the same verdict {sum(same.values())} times {dict(same)}, another {len(other)} times: {other[:20]}")
    return len(other) > len(requests) * 0.03


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--simulator", type=pathlib.Path, default=ROOT / "build/release/bin/natator-sim")
    parser.add_argument("--scheme", action="append", choices=("flex", "conserving"), help="only this one")
    parser.add_argument("--scenes", type=int, default=3000, help="for each scheme (default: 3000)")
    parser.add_argument("--first", type=int, default=0, help="number of the first (default: 0)")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="end after so long (default: no limit)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--gpu", action="store_true", help="compare the verdicts of a GPU with the CPU's instead")
    parser.add_argument("--show", metavar="LAW", help="also print scenes that broke this law")
    options = parser.parse_args()
    program = Program(options.simulator, ROOT / "build/fuzz")
    begin, faults = time.monotonic(), 0
    for scheme in options.scheme or ("flex", "conserving"):
        if options.gpu:
            faults += on_gpu(scheme, options, program)
            continue
        outcomes, laws = collections.Counter(), collections.Counter()
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            def guarded(number):
                late = time.monotonic() - begin > options.seconds
                return None if late else run(number, options.seed, scheme, program)
            for number, result in enumerate(pool.map(guarded, range(options.first, options.first + options.scenes)), options.first):
                if result is None:
                    continue
                outcome, law, fault, scene, gait = result
                outcomes[outcome] += 1
                if outcome == "unstable":
                    laws[law] += 1
                if outcome == "refused":
                    laws["refused: " + law.split(": ", 1)[-1][:60]] += 0
                if fault or (options.show and law == options.show):
                    faults += bool(fault)
                    again = {key: value for key, value in scene.items()}
                    print(f"{scheme} {number}: {fault or law}\n  {shlex.quote(json.dumps(again))}\n  {json.dumps(gait)}", flush=True)
        told = ", ".join(f"{count} {name}" for name, count in outcomes.most_common())
        print(f"{scheme}: {told}; unstable by law: {dict(+laws)}", flush=True)
        if outcomes["refused"] > 0.5 * max(1, sum(outcomes.values())):
            print(f"{scheme}: most scenes are refused, nothing is tried")
            faults += 1
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
