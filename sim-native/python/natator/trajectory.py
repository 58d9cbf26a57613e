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
    force: np.ndarray = None  #: T × N × 3, of the water over the frame, mass length/s²


def record(scene, gait=None, duration=4.0, every=1, fields=("position",), **options):
    """Swims for `duration` seconds and keeps every `every`th frame. `options`: those of Stream. Raises InputError and
    Unstable. It does not end early as an evaluation may."""
    with Stream(scene, gait=gait, fields=fields or ("position",), **options) as stream:
        return joined(list(frames(stream, duration, every)), stream.scene)


def frames(stream, duration, every=1, least=0, water=False):
    """The frame of a fresh stream and every `every`th of those after it, until `duration` seconds, to the nearest frame, are over,
    `least` at least; each is simulated while the one before it is used. water: stream.last_water is that of the frame. Raises
    InputError and Unstable."""
    if number("duration", duration) < 0 or least and not duration:
        raise InputError(f"duration = {duration}: must be {'above' if least else 'at least'} 0 s")
    whole("every", every, 1)
    stream.require_stable()
    longest = MAX_STEPS * stream.scene["timeStep"]
    if duration > longest:
        raise InputError(f"duration = {duration}: must be at most {longest:g} s, {MAX_STEPS} time steps")
    steps = [min(left, 1000) for left in range(every, 0, -1000)]
    frame, count = stream.frame, max(least, int(duration / stream.scene["timeStep"] + 0.5)) // every
    for _ in range(count):
        if water:
            stream.send(stream.water_command)
        for step in steps:
            stream.send({"do": "credit"})
            stream.send({"do": "step", "frames": step})
        if water:
            stream.receive()
        yield frame
        for _ in 2 * steps:
            stream.receive()
            stream.require_stable()
        frame = stream.frame
    if water:
        stream.water()
    yield frame


def joined(frames, scene):
    """The Trajectory of all these frames."""
    def all_of(name):
        values = [getattr(frame, name) for frame in frames]
        return None if values[0] is None else np.array(values)

    first, count = scene["fluid"]
    return Trajectory(*(all_of(name) for name in ("time", "distance", "drive", "position", "velocity", "density")),
                      body=np.array(scene["body"], int), fluid=slice(first, first + count), scene=scene, force=all_of("force"))


MAX_STEPS = 10**7  # of an evaluation, as the simulator has it
