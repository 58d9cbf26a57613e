#!/usr/bin/env python3
"""Swims to a target by trying: from each moment it tries several commands, and takes what came nearest (model-predictive control)."""

import argparse

import numpy as np

import natator
from natator import script
from natator.gait import wave

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
parser.add_argument("--scene", default="pool/tadpole")
parser.add_argument("--target", type=float, nargs=3, default=[2.2, 0.5, 0.8], metavar=("X", "Y", "Z"))
parser.add_argument("--duration", type=float, default=2.0, help="s, above 0")
parser.add_argument("--ahead", type=int, default=30, help="frames that each try looks ahead, of which the first fifth is swum")
parser.add_argument("--warm-up", type=float, default=0.0, help="s that it swims first, so that it begins in its own wake")
parser.add_argument("--keep", default="", metavar="FILE", help="where the state after that is written, and read if it is there")


def wake(swimmer, options):
    """Begins in the wake of an earlier run, or makes it."""
    try:
        with open(options.keep, "rb") as file:
            swimmer.restore(file.read())
    except FileNotFoundError:
        senses = swimmer.sense()
        while senses.time < options.warm_up:
            senses = swimmer.step()
        if options.keep:
            with open(options.keep, "wb") as file:
                file.write(swimmer.save())


def swim(options):
    if not options.duration > 0 or options.ahead < 5:
        raise natator.InputError(f"duration = {options.duration}, ahead = {options.ahead}: must be above 0 (s), and at least 5")
    with natator.Stream(options.scene) as swimmer:
        swimmer.set_gait(wave(swimmer.actuators, frequency=2, amplitude=0.9, waves=0.8))
        wake(swimmer, options)
        senses = swimmer.sense(target=options.target)
        end = senses.time + options.duration
        while senses.time < end and not senses.touches_plane:
            now, left = swimmer.save(), {}
            for bend in (-0.5, 0.0, 0.5):
                left[bend] = swimmer.step(options.ahead, offset=np.full(swimmer.actuators, bend)).target_distance
                swimmer.restore(now)  # its own last state, which need not be sent
            best = min(left, key=left.get)
            senses = swimmer.step(options.ahead // 5, offset=np.full(swimmer.actuators, best))
            print(f"{senses.time:5.2f} s  {senses.target_distance:.3f} to go, bends by {best:+.1f}", flush=True)


script.run(parser, swim)
