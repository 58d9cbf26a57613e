#!/usr/bin/env python3
"""Evolves a gait by CMA-ES (pycma): ask for gaits, evaluate them side by side, tell how far they swam."""

import argparse
import warnings

with warnings.catch_warnings():  # that there is no matplotlib
    warnings.simplefilter("ignore")
    import cma
import natator
from natator import script
from natator.gait import whole
from natator.simulator import make_request

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
parser.add_argument("--scene", default="pool/creature-1")
parser.add_argument("--duration", type=float, default=2.0, help="s")
parser.add_argument("--evaluations", type=int, default=48, help="at least, from 1; whole generations are finished")
parser.add_argument("--workers", type=int, default=argparse.SUPPRESS, help="programs side by side, from 1; one for each processor if left out")
parser.add_argument("--seed", type=int, default=1, help="from 1, below 2**32")


def evolve(options):
    whole("evaluations", options.evaluations, 1)
    if whole("seed", options.seed, 1) >= 2**32:
        raise natator.InputError(f"seed = {options.seed}: must be below 2**32")
    with natator.Stream(options.scene) as scene:
        actuators = scene.actuators
        if actuators == 0:
            raise natator.InputError(f'scene "{options.scene}": must have a creature with actuators')

    def gait_of(genes):
        """Genes are in [0, 1]: frequency, then amplitudes, then phases."""
        return natator.Gait(0.5 + 1.5 * genes[0], genes[1:1 + actuators], genes[1 + actuators:])

    with natator.Simulator(getattr(options, "workers", None)) as simulator:
        search = cma.CMAEvolutionStrategy([0.5] * (1 + 2 * actuators), 0.25, {
            "bounds": [0, 1], "seed": options.seed, "verbose": -9})
        while search.result.evaluations < options.evaluations and not search.stop():
            asked = search.ask()
            results = simulator.evaluate_all(
                [make_request(options.scene, gait_of(genes), duration=options.duration) for genes in asked])
            search.tell(asked, [-result["fitness"] for result in results])
            print(f"{search.result.evaluations:4d} evaluations: best {-search.result.fbest:.4f}", flush=True)

    best = gait_of(search.result.xbest)
    print(f"frequency {best.frequency:.3f}, amplitude {best.amplitude.round(3).tolist()}, phase {best.phase.round(3).tolist()}")


script.run(parser, evolve)
