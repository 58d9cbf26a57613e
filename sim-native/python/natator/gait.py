"""Gaits: how muscles are driven."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Gait:
    """Actuator i is driven by offset[i] + amplitude[i] sin 2π(frequency t + phase[i]).

    frequency in 1/s, (0, 60]; amplitude without unit, [0, 2] (1 shortens the outermost muscles by half); phase in turns,
    [0, 1]; offset without unit, 0 everywhere if None; power of request.schema.json, 1 = the plain sine.
    """

    frequency: float
    amplitude: list
    phase: list
    offset: list = None
    power: float = 1.0

    def to_json(self):
        """As a request has it."""
        gait = {"frequency": float(self.frequency), "amplitude": numbers(self.amplitude), "phase": numbers(self.phase),
                "power": float(self.power)}
        return gait if self.offset is None else gait | {"offset": numbers(self.offset)}


def wave(actuators, frequency=1.5, amplitude=0.8, waves=0.6):
    """A wave that runs from head to tail, so many of its lengths at a time on the body."""
    phase = [(1 - waves * i / max(actuators, 1)) % 1 for i in range(actuators)]
    return Gait(frequency, [amplitude] * actuators, phase)


def wave_in(scene):
    """A wave for the creature of a SCEN message. Where its actuators bend it both ways, those that are not like the first
    rest."""
    ways = {muscle["actuator"]: muscle.get("bend") for muscle in scene["muscles"]}
    beating = sum(ways[i] == ways[0] for i in range(scene["actuators"]))
    gait, rest = wave(beating), [0.0] * (scene["actuators"] - beating)
    return Gait(gait.frequency, gait.amplitude + rest, gait.phase + rest)


def numbers(values):
    """A list of numbers, from any sequence or array."""
    return [float(value) for value in np.asarray(values, dtype=float).ravel()]


def as_json(gait):
    """A gait, or a mapping that is one already, as a request has it."""
    return gait.to_json() if isinstance(gait, Gait) else gait
