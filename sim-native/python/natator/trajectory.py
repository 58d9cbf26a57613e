"""Whole swims as arrays."""

from dataclasses import dataclass

import numpy as np

from natator.errors import InputError
from natator.gait import number, whole
from natator.stream import Stream


@dataclass(frozen=True)
class Trajectory:
    """T frames of N particles, the start first. Arrays of fields that were not asked for are None."""

    time: np.ndarray      #: T, s
    distance: np.ndarray  #: T, change of the body's mean x, length
    drive: np.ndarray     #: T × A, of each actuator
    position: np.ndarray  #: T × N × 3, length
    velocity: np.ndarray  #: T × N × 3, length/s
    density: np.ndarray   #: T × N, rest densities; 0 for solids
    body: np.ndarray      #: which particles are the body's
    fluid: slice          #: which are water: position[:, fluid]
    scene: dict           #: the SCEN message of the stream


def record(scene, gait=None, duration=4.0, every=1, fields=("position",), **options):
    """Swims for `duration` seconds and keeps every `every`th frame. `options`: those of Stream. Raises InputError and
    Unstable. It does not end early as an evaluation may."""
    if number("duration", duration) < 0:
        raise InputError(f"duration = {duration}: must be at least 0 s")
    whole("every", every, 1)
    with Stream(scene, gait=gait, fields=fields or ("position",), **options) as stream:
        longest = MOST_STEPS * stream.scene["timeStep"]
        if duration > longest:
            raise InputError(f"duration = {duration}: must be at most {longest:g} s, {MOST_STEPS} time steps")
        frames = [stream.frame]
        for _ in range(int(duration / stream.scene["timeStep"] + 0.5) // every):
            for left in range(every, 0, -1000):
                stream.step(min(left, 1000))
            frames.append(stream.frame)
        return _joined(frames, stream.scene)


def _joined(frames, scene):
    def all_of(name):
        values = [getattr(frame, name) for frame in frames]
        return None if values[0] is None else np.array(values)

    first, count = scene["fluid"]
    return Trajectory(*(all_of(name) for name in ("time", "distance", "drive", "position", "velocity", "density")),
                      body=np.array(scene["body"], int), fluid=slice(first, first + count), scene=scene)


MOST_STEPS = 10**7  # of an evaluation, as the simulator has it
