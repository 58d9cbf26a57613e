"""Conversion of values to what JSON can hold."""

import json
import math
import os
import sys

import numpy as np

from natator.errors import InputError
from natator.gait import Gait


DEEPEST = 100  # more than the simulator takes; what holds itself has no end


def plain(name, value, depth=0):
    """A value without numpy's types, paths and gaits in it. Raises InputError, which names the place, for what JSON has no form
    for, and for numbers that are not finite."""
    if depth > DEEPEST:
        raise InputError(f"{name[:60]}…: nested deeper than {DEEPEST} levels")
    if isinstance(value, Gait):
        value = value.to_json()
    if isinstance(value, dict):
        for key in value:
            if not isinstance(key, str):
                raise InputError(f"{name}: key {key!r}: must be a text" if name else f"key {key!r}: must be a text")
        return {key: plain(f"{name}.{key}" if name else key, part, depth + 1) for key, part in value.items()}
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(f"{name}[{i}]", part, depth + 1) for i, part in enumerate(value)]
    if isinstance(value, os.PathLike):
        return os.fsdecode(value)
    if isinstance(value, float) and not math.isfinite(value):
        raise InputError(f"{name} = {value}: must be a finite number")
    if value is not None and not isinstance(value, (bool, int, float, str)):
        raise InputError(f"{name} = {value!r}: must be a number, a text, a list or a dict")
    return value


def line(value, name=""):
    """A dict as one line of JSON, as bytes."""
    return json.dumps(plain(name, value)).encode() + b"\n"


def is_number(value):
    """Whether a value that was read from JSON is a number that a float can hold."""
    return type(value) in (int, float) and abs(value) <= sys.float_info.max


def is_whole(value, least=0):
    """Whether a value is a whole number, at least `least`."""
    return type(value) is int and value >= least
