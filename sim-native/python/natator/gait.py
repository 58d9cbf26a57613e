"""Gaits: how muscles are driven."""

import operator
from dataclasses import dataclass

import numpy as np

from natator.errors import InputError


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
        gait = {"frequency": number("gait.frequency", self.frequency), "amplitude": numbers("gait.amplitude", self.amplitude),
                "phase": numbers("gait.phase", self.phase), "power": number("gait.power", self.power)}
        return gait if self.offset is None else gait | {"offset": numbers("gait.offset", self.offset)}


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


def rows(name, values):
    """An array of finite numbers, from any sequence or array; neither texts nor truths count as such."""
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise InputError(f"{name}: must be numbers, in rows of the same length") from error
    if array.dtype.kind not in "iuf":
        raise InputError(f"{name} = {values!r}: must be numbers")
    for place in np.argwhere(~np.isfinite(array)):
        at = "".join(f"[{i}]" for i in place)
        raise InputError(f"{name}{at} = {array[tuple(place)]}: must be a finite number")
    return array.astype(float)


def numbers(name, values):
    """A list of numbers."""
    return rows(name, values).ravel().tolist()


def number(name, value):
    array = rows(name, value)
    if array.ndim:
        raise InputError(f"{name} = {value!r}: must be one number")
    return float(array)


def whole(name, value, least):
    """An int from `least` on; nothing is rounded."""
    try:
        count = None if isinstance(value, (bool, np.bool_)) else operator.index(value)
    except TypeError:
        count = None
    if count is None or count < least:
        raise InputError(f"{name} = {value!r}: must be a whole number from {least} on")
    return count


def as_json(gait):
    """A gait, or a mapping that is one already, as a request has it."""
    return gait.to_json() if isinstance(gait, Gait) else gait
