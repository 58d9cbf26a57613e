"""The thesis' tank without a swimmer in Genesis, by its position based fluid or its DFSPH: what Natator's speed is compared with.

4 s on one core, float. Prints a line of JSON: solver, particles, substeps, seconds of the processor (without compiling), mean_density_error, version.

    pip install torch genesis-world==1.4.5
    python genesis_water.py [--solver pbd] [--duration 4] [--substeps 4] [--iterations 4]
"""

import argparse
import json
import os
import time

os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})

import genesis as gs  # noqa: E402: it counts the cores
import numpy as np  # noqa: E402

COUNT, SPACING, FRAMES = (50, 17, 7), 0.09, 60  # its third axis is up


def density_error(places):
    """Mean of max(density - 1, 0): cubic splines over two spacings, against those of a lattice as dense as Genesis takes water to be, whose particles
    have 0.8 of the cubes around them."""
    lattice = 0.8 ** (1 / 3) * SPACING * (np.arange(7**3)[:, None] // (1, 7, 49) % 7 - 3)
    rest = spline(np.linalg.norm(lattice, axis=1)).sum()
    densities = [spline(np.linalg.norm(places - place, axis=1)).sum() / rest for place in places]
    return float(np.maximum(np.array(densities) - 1, 0).mean())


def spline(distance):
    q = distance / SPACING
    return np.where(q < 1, 1 - 1.5 * q**2 + 0.75 * q**3, np.where(q < 2, 0.25 * np.maximum(2 - q, 0) ** 3, 0))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--solver", choices=("pbd", "dfsph"), default="pbd")
    parser.add_argument("--duration", type=float, default=4.0, help="simulated time, s")
    parser.add_argument("--substeps", type=int, default=4, help="per frame of 1/60 s")
    parser.add_argument("--iterations", type=int, default=4, help="of pbd, per substep")
    options = parser.parse_args()
    gs.init(backend=gs.cpu, precision="32", logging_level="error")
    size = [SPACING * count for count in COUNT]
    bounds = {"particle_size": SPACING, "lower_bound": (0, 0, 0), "upper_bound": (size[0], size[1], 2.0)}
    if options.solver == "pbd":
        own, kind = {"pbd_options": gs.options.PBDOptions(**bounds, max_density_solver_iterations=options.iterations)}, gs.materials.PBD
    else:
        own, kind = {"sph_options": gs.options.SPHOptions(**bounds, pressure_solver="DFSPH")}, gs.materials.SPH
    scene = gs.Scene(sim_options=gs.options.SimOptions(dt=1 / FRAMES, substeps=options.substeps, gravity=(0, 0, -9.8)), show_viewer=False, **own)
    water = scene.add_entity(material=kind.Liquid(sampler="regular"), morph=gs.morphs.Box(lower=(0, 0, 0), upper=tuple(size)))
    scene.build()
    scene.step()  # compiles
    scene.reset()
    begun = time.process_time()
    for _ in range(round(options.duration * FRAMES)):
        scene.step()
    seconds = time.process_time() - begun
    places = np.asarray(water.get_particles_pos().cpu()).reshape(-1, 3)
    if not np.all(np.isfinite(places)):
        raise SystemExit("genesis_water.py: places are not finite; expected water")
    print(json.dumps({"solver": options.solver, "particles": len(places), "substeps": options.substeps, "seconds": seconds,
                      "mean_density_error": density_error(places), "height": float(places[:, 2].max()), "version": gs.__version__}))


main()
