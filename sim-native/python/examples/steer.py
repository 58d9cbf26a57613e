#!/usr/bin/env python3
"""Swims to a target: the gait beats, and a controller bends the body towards where the target is sensed."""

import argparse

import natator
from natator import script
from natator.gait import wave

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
parser.add_argument("--scene", default="pool/tadpole")
parser.add_argument("--target", type=float, nargs=3, default=[2.2, 0.5, 0.8], metavar=("X", "Y", "Z"))
parser.add_argument("--duration", type=float, default=2.0, help="s, above 0")


def swim(options):
    if not options.duration > 0:
        raise natator.InputError(f"duration = {options.duration}: must be a number above 0 (s)")
    with natator.Stream(options.scene) as swimmer:
        swimmer.set_gait(wave(swimmer.actuators, frequency=2, amplitude=0.9, waves=0.8))
        senses = swimmer.sense(target=options.target)
        while senses.time < options.duration and not senses.touches_plane:
            to_right = senses.target[2]  # along own axes: forward, up, right
            bend = max(-0.5, min(0.5, -2 * to_right))  # a positive one bends to the left
            senses = swimmer.step(6, offset=[bend] * swimmer.actuators)
            print(f"{senses.time:5.2f} s  {senses.target_distance:.3f} to go, target {to_right:+.2f} to the right", flush=True)


script.run(parser, swim)
