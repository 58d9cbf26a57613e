"""Cases of water in SPlisHSPlasH's DFSPH, for peers.py. Run by a Python that has pysplishsplash:

    python splishsplash.py CASE STEP

CASE: vortex, column or tank. STEP: "adaptive" (as SPlisHSPlasH's own scenes have it: CFL factor 1, at most 5 ms) or a
fixed time step in s. Prints one JSON object: version, particles, run_time (processor time, s, of the time steps of the measured
part, on one thread) and values by quantity.

Setting, otherwise as in SPlisHSPlasH's scenes of breaking dams: cubic spline over two particle distances, density error at
most 0.05 %, divergence error at most 0.1 %, walls of sampled particles (Akinci et al. 2012) half a distance behind those of
the case, no viscosity at them. Particles have the volume and the starting places of Natator's.
"""
import ctypes
import glob
import importlib.metadata
import json
import math
import os
import sys
import sysconfig
import tempfile
import time

os.environ["OMP_NUM_THREADS"] = "1"
# The wheel brings a libGLdispatch of its own. Beside one of the system's it crashes unless it is there first.
for library in glob.glob(os.path.join(sysconfig.get_paths()["platlib"], "pysplishsplash.libs", "libGLdispatch*")):
    ctypes.CDLL(library, mode=ctypes.RTLD_GLOBAL)

import numpy as np  # noqa: E402
import pysplishsplash as sph  # noqa: E402

spacing = 0.1
gravity = 10
settling, settling_viscosity, settling_damping = 2, 0.05, 4  # s, length^2/s, 1/s
box_mesh = """v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 4 8 7\nf 4 7 3\nf 1 5 8\nf 1 8 4\nf 2 3 7\nf 2 7 6\n"""


def scene(box, count, step):
    """`count` particles along each axis in a box of the size `box`; their places are set later."""
    behind = spacing / 2
    return {
        "Configuration": {
            "particleRadius": spacing / 2,
            "simulationMethod": 4,
            "gravitation": [0, -gravity, 0],
            "timeStepSize": step or 0.005,
            "cflMethod": 0 if step else 1,
            "cflFactor": 1,
            "cflMaxTimeStepSize": 0.005,
            "boundaryHandlingMethod": 0,
            "DFSPH": {"minIterations": 2, "maxIterations": 100, "maxError": 0.05, "maxIterationsV": 100,
                      "maxErrorV": 0.1, "enableDivergenceSolver": True},
        },
        "Materials": [{"id": "Fluid", "density0": 1000, "viscosityMethod": 1,
                       "Standard viscosity": {"viscosity": settling_viscosity, "viscosityBoundary": 0}}],
        "RigidBodies": [{"geometryFile": "box.obj", "translation": [-behind] * 3, "rotationAxis": [1, 0, 0],
                         "rotationAngle": 0, "scale": [length + 2 * behind for length in box], "isDynamic": False,
                         "isWall": True, "mapInvert": True, "samplingMode": 0}],
        "FluidBlocks": [{"denseMode": 0, "start": [0, 0, 0], "end": [(n + 1) * spacing for n in count],
                         "translation": [0, 0, 0], "scale": [1, 1, 1]}],
    }


class Tank:
    """Water that has come to rest, as Natator's studies let it."""

    def __init__(self, box, count, places, step):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "box.obj"), "w") as mesh:
                mesh.write(box_mesh)
            with open(os.path.join(folder, "scene.json"), "w") as file:
                json.dump(scene(box, count, step), file)
            self.program = sph.Exec.SimulatorBase()
            self.program.init(sceneFile=os.path.join(folder, "scene.json"), useGui=False, initialPause=False,
                              useCache=False, outputDir=folder)
            self.program.initSimulation()
            self.fluid = sph.Simulation.getCurrent().getFluidModel(0)
            self.particles = self.fluid.numActiveParticles()
            self.position, self.velocity = self.field("position"), self.field("velocity")
            if self.particles != len(places) or not math.isclose(self.fluid.getVolume(0), spacing**3, rel_tol=1e-4):
                sys.exit(f"splishsplash.py: {self.particles} particles of {self.fluid.getVolume(0)}, expected {len(places)} "
                         f"of {spacing**3:g}")
            random = np.random.default_rng(20)
            self.position[:] = places + random.uniform(-spacing / 5, spacing / 5, places.shape)
            # Only runSimulation ends the initialisation; it makes a step or two.
            self.program.setValueFloat(self.program.STOP_AT, 1e-6)
            self.program.runSimulation()
            self.program.setValueFloat(self.program.STOP_AT, -1.0)
        self.clock = sph.TimeManager.getCurrent()
        self.run(settling, self.damp)
        self.velocity[:] = 0
        viscosity = self.fluid.getViscosityBase()
        viscosity.setValueFloat(viscosity.VISCOSITY_COEFFICIENT, 0.0)

    def field(self, name):
        return np.array(self.fluid.getFieldBuffer(name), copy=False)[: self.fluid.numActiveParticles()]

    def damp(self, _):
        self.velocity[:] *= math.exp(-settling_damping * self.clock.getTimeStepSize())

    def run(self, duration, after_step):
        """Calls after_step(time) after each step; returns the processor time, s, of all."""
        start, seconds = self.clock.getTime(), 0
        while self.clock.getTime() - start < duration - 1e-6:
            begin = time.process_time()
            self.program.timeStepNoGUI()
            seconds += time.process_time() - begin
            after_step(self.clock.getTime() - start)
        return seconds

    def depth(self):
        return 2 * self.position[:, 1].mean(dtype=float)


def lattice(count):
    """From the floor up."""
    x, y, z = (np.arange(n) for n in count)
    y, x, z = (axis.ravel() for axis in np.meshgrid(y, x, z, indexing="ij"))
    return (np.stack([x, y, z], axis=-1) + 0.5) * spacing


def vortex(step):
    """As run_vortex in vortex.cpp."""
    length, speed, count = 2, 0.5, (20, 8, 20)
    k, turnover = math.pi / length, length / speed
    tank = Tank((length, length, length), count, lattice(count), step)

    def flow():
        x, z = (k * tank.position[:, axis].astype(float) for axis in (0, 2))
        return speed * np.stack([np.sin(x) * np.cos(z), np.zeros_like(x), -np.cos(x) * np.sin(z)], axis=-1)

    def energy():
        return np.square(tank.velocity, dtype=float).sum()

    tank.velocity[:] = flow()
    first_energy = energy()
    samples, energies = [(0, 1)], [first_energy]

    def observe(now):
        exact = flow()
        samples.append((now, (exact * tank.velocity).sum() / (exact**2).sum()))
        energies.append(energy())

    seconds = tank.run(4 * turnover, observe)
    product = square = 0
    for now, amplitude in samples:
        if amplitude < 0.05:
            break
        product -= now * math.log(amplitude)
        square += now * now
    viscosity = product / square / (2 * k * k)
    return tank, seconds, {
        "amplitude after one turnover": next(amplitude for now, amplitude in samples if now >= turnover - 1e-6),
        "numerical Reynolds number": speed * length / viscosity if viscosity > 0 else 1e6,
        "gain of kinetic energy": max(energies) / first_energy - 1,
    }


def column(step):
    """As run_column in column.cpp. DFSPH's two solvers share the load, so that their pressures are added."""
    count, apart = (10, 20, 10), 2.5 * spacing
    tank = Tank((1, 3, 1), count, lattice(count), step)
    pressure, divergence_pressure = tank.field("p / rho^2"), tank.field("p_v / rho^2")
    sums = np.zeros(4)

    def observe(_):
        depth, y, h = tank.depth(), tank.position[:, 1], tank.clock.getTimeStepSize()
        inside = (y <= 0.6 * depth) & (tank.position >= apart).all(1) & (tank.position[:, ::2] <= 1 - apart).all(1)
        measured = pressure[inside].sum(dtype=float) / h**2 + divergence_pressure[inside].sum(dtype=float) / h
        hydrostatic = gravity * (depth - y[inside]).sum(dtype=float)
        square = np.square(tank.velocity, dtype=float).sum() / tank.particles
        sums[:] += h * np.array([measured, hydrostatic, depth, square])

    duration = 2
    seconds = tank.run(duration, observe)
    return tank, seconds, {
        "pressure (of the hydrostatic)": sums[0] / sums[1],
        "depth (length)": sums[2] / duration,
        "speed at rest (length/s)": math.sqrt(sums[3] / duration),
    }


def tank(step):
    """As run_settled_tank in settled_tank.cpp; run_time is that of 4 s."""
    count = (50, 7, 17)
    water = Tank((4.51, 3, 1.54), count, lattice((45, 9, 15))[: math.prod(count)], step)
    density = water.field("density")
    seconds = water.run(1, lambda _: None)
    errors = []

    def observe(_):
        error = density.astype(float) / 1000 - 1
        deep = water.position[:, 1] <= water.depth() - 0.3
        errors.append((np.maximum(error, 0).mean(), error.max(), np.abs(error[deep]).mean()))

    window = 0.5
    seconds += water.run(window, observe)
    mean, largest, deviation = np.array(errors).T
    return water, seconds * 4 / (1 + window), {
        "density error, mean": mean.mean(),
        "density error, largest": largest.max(),
        "density deviation in the deep": deviation.mean(),
    }


def main():
    cases = {"vortex": vortex, "column": column, "tank": tank}
    if len(sys.argv) != 3 or sys.argv[1] not in cases:
        sys.exit("usage: splishsplash.py vortex|column|tank adaptive|STEP_IN_S")
    # SPlisHSPlasH logs to the standard output.
    output = os.dup(1)
    os.dup2(2, 1)
    water, seconds, values = cases[sys.argv[1]](None if sys.argv[2] == "adaptive" else float(sys.argv[2]))
    row = {"version": importlib.metadata.version("pysplishsplash"), "particles": water.particles, "run_time": seconds,
           "values": {quantity: float(value) for quantity, value in values.items()}}
    os.write(output, (json.dumps(row) + "\n").encode())
    os._exit(0)  # it does not survive Python's own clean-up


if __name__ == "__main__":
    main()
