"""A swimmer that a program drives, through `natator-sim stream` (sim-native/protocol/stream.md)."""

import json
import os
import re
import struct
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from natator import program as programs
from natator.errors import InputError, ProgramError, Unstable
from natator.gait import Gait, numbers, rows, whole
from natator.plain import line, plain

SIDES = ("left", "right", "above", "below")


def pairs(name, values):
    """Two values each, of any sequence of such."""
    try:
        return [(first, second) for first, second in values]
    except (TypeError, ValueError):
        raise InputError(f"{name} = {values!r}: must be pairs of two values each") from None


@dataclass(frozen=True)
class Senses:
    """What a swimmer knows of itself and of the water. Own axes are forward, up and right of the body."""

    frame: int                #: since the start
    time: float               #: s
    distance: float           #: change of the mean x of its particles, length
    touches_plane: bool
    work: float               #: of the muscles since the start; nan in scheme flex, which has no forces
    centre: np.ndarray        #: mean of its particles, length
    forward: np.ndarray       #: own axes, of length 1
    up: np.ndarray
    right: np.ndarray
    velocity: np.ndarray      #: of its centre of mass along own axes, length/s
    turn_rate: np.ndarray     #: about own axes, rad/s
    drive: np.ndarray         #: of each actuator
    bend: np.ndarray          #: how each actuator's muscles are contracted, in units of drive
    flow: np.ndarray          #: K × 3: water relative to each place of the skin that was asked for, own axes, length/s
    flow_particles: np.ndarray  #: K: how many particles of water each is a mean over
    target: np.ndarray        #: direction of the target along own axes, of length 1; nan without one
    target_distance: float    #: length; nan without one

    @classmethod
    def from_json(cls, senses):
        flow, target = senses.get("flow", []), senses.get("target", {})
        return cls(
            senses["frame"], senses["time"], senses["distance"], senses["touchesPlane"], senses.get("work", np.nan),
            *(np.array(senses[key], float) for key in
              ("centre", "forward", "up", "right", "velocity", "turnRate", "drive", "bend")),
            np.array([place["velocity"] for place in flow], float).reshape(-1, 3),
            np.array([place["particles"] for place in flow], int),
            np.array(target.get("direction", [np.nan] * 3), float), target.get("distance", np.nan))


@dataclass(frozen=True)
class Frame:
    """The particles at a time. Arrays are the simulator's own 32-bit numbers; those that were not asked for are None."""

    number: int
    time: float             #: s
    distance: float         #: length
    drive: np.ndarray       #: A
    position: np.ndarray    #: N × 3, length
    velocity: np.ndarray    #: N × 3, length/s
    density: np.ndarray     #: N, rest densities; 0 for solids


class Stream:
    """A scene that stands still until it is told to step: the same commands give the same bits.

    scene: name or path. gait, overrides (a dict merged into the scene), scheme, start (an int: which of its many starts):
    as in a request. fields: what frames hold of each particle, of "position", "velocity", "density"; without any there are
    no frames. arguments: a list of more arguments of `natator-sim stream`. To be closed; a context manager. Raises InputError.

    Attributes: `scene`, the SCEN message as a dict (particles, body, slices, bodyLength, actuators …); `frame`, the last
    Frame, None without fields.
    """

    def __init__(self, scene, gait=None, overrides=None, scheme=None, start=None, fields=(), arguments=(), program=None):
        fields = [fields] if isinstance(fields, str) else programs.listed("fields", fields)
        arguments = programs.listed("arguments", arguments)
        if not isinstance(scene, (str, os.PathLike)):
            raise InputError(f"scene = {scene!r}: must be a name or a path")
        options = ["stream", scene, "--paused", "--fields", ",".join(fields) or "none"]
        for name, value in (("--gait", gait), ("--overrides", overrides)):
            if value is None:
                continue
            if not isinstance(value, (Mapping, Gait)):
                raise InputError(f"{name.removeprefix('--')} = {value!r}: must be a dict" + " or a Gait" * (name == "--gait"))
            options += [name, json.dumps(plain(name.removeprefix("--"), value))]
        for name, value in (("--scheme", scheme), ("--start", start)):
            if value is not None:
                options += [name, value]
        self.scene, self.frame = {}, None
        self._framed = bool(fields)
        self._unstable, self._closed = None, False
        self._unanswered, self._torn = 0, False
        self._process = programs.start(program, [*options, *arguments])
        try:
            self._take(*self._message())
            self._first_frame()
        except BaseException:
            self.close()
            raise

    @property
    def actuators(self):
        return self.scene["actuators"]

    def sense(self, flow=None, within=None, target=None, **more):
        """Says what is to be sensed from now on, and gives the senses now. flow: places of the skin as (slice, side), side
        one of "left", "right", "above", "below"; within: of a place water counts, length; target: where the swimmer shall
        go, length. What is left out stays as it was."""
        places = None if flow is None else [{"slice": whole(f"flow[{i}].slice", place, 0), "side": side}
                                            for i, (place, side) in enumerate(pairs("flow", flow))]
        command = {"do": "sense", "target": None if target is None else numbers("target", target), "within": within,
                   "flow": places, **more}
        return self._senses(self.ask({key: value for key, value in command.items() if value is not None}))

    def step(self, frames=None, drive=None, scale=None, offset=None):
        """Simulates frames; the senses at the end. drive: a value in [-2, 2] for each actuator, or a row of them for each
        frame, in place of the gait; scale, offset: what the gait gives, times scale plus offset. They stay until changed.
        Raises InputError, and then nothing was simulated; raises Unstable."""
        self.require_idle()
        self.begin_step(frames, drive, scale, offset)
        return self.end_step()

    def begin_step(self, frames=None, drive=None, scale=None, offset=None):
        """The first half of `step`: does not wait. Several may be begun before the first is ended."""
        command = {"do": "step", "sense": True}
        if frames is not None:
            command["frames"] = whole("frames", frames, 1)
        if drive is not None:
            command["drive"] = rows("drive", drive).tolist()
        for name, values in (("scale", scale), ("offset", offset)):
            if values is not None:
                command[name] = numbers(name, values)
        if self._framed:
            self.send({"do": "credit"})
        self.send(command)

    def end_step(self):
        """The second half."""
        if self._framed:
            self.receive()
        return self._senses(self.receive())

    def steer(self, scale=None, offset=None):
        """From the next frame on; without arguments the gait alone drives again."""
        self.ask({"do": "steer", **{name: numbers(name, values) for name, values in (("scale", scale), ("offset", offset))
                                    if values is not None}})

    def set_gait(self, gait):
        """From the next frame on."""
        self.ask({"do": "gait", "gait": gait})

    def reset(self, start=None):
        """Back to the settled start, or to another of the scene's starts; what is sensed stays."""
        self.require_idle()
        self.begin_reset(start)
        self.end_reset()

    def begin_reset(self, start=None):
        """The first half of `reset`: does not wait."""
        self.send({"do": "reset"} if start is None else {"do": "reset", "start": whole("start", start, 0)})

    def end_reset(self):
        """The second half."""
        self.receive()
        self._first_frame()

    def ask(self, command):
        """Sends any command of the protocol; its answer. Raises InputError."""
        self.require_idle()
        self.send(command)
        return self.receive()

    def require_idle(self):
        """Raises ProgramError if an answer is still to come: a call was interrupted, and all later answers would be taken for
        others."""
        if self._torn or self._unanswered:
            raise ProgramError("a call was interrupted before its answer was read: close the stream and open another")

    def send(self, command):
        """Sends a command without waiting for its answer."""
        if self._closed:
            raise ProgramError("the stream is closed")
        text, self._torn = line(command), True
        try:
            self._process.stdin.write(text)
            self._process.stdin.flush()
        except BrokenPipeError:
            raise programs.ended(self._process) from None
        self._unanswered, self._torn = self._unanswered + 1, False

    def receive(self):
        """The answer to the first command that has none yet. Raises InputError."""
        while True:
            letters, body = self._message()
            if letters != b"ANSW":
                self._take(letters, body)
                continue
            self._unanswered -= 1
            answer = json.loads(body)
            if "error" in answer:
                raise InputError(answer["error"])
            return answer

    def close(self):
        if not self._closed:
            self._closed = True
            programs.stop(self._process)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def require_stable(self):
        """Raises Unstable if the simulation has stopped so."""
        if self._unstable:
            raise Unstable(*self._unstable)

    def _senses(self, answer):
        self.require_stable()
        return Senses.from_json(answer["senses"])

    def _first_frame(self):
        """The settled start, which waits for credit."""
        if self._framed and not self._unstable:
            self.ask({"do": "credit"})
            if not self._unstable:  # which is told before the answer
                self._take(*self._message())

    def _message(self):
        self._torn = True
        head = self._read(8)
        if not re.fullmatch(b"[A-Z]{4}", head[:4]):
            raise programs.no_simulator(self._process)
        body = self._read(struct.unpack_from("<I", head, 4)[0])
        self._torn = False
        return head[:4], body

    def _read(self, size):
        data = self._process.stdout.read(size)
        if len(data) < size:
            raise programs.ended(self._process)
        return data

    def _take(self, letters, body):
        if letters == b"SCEN":
            change = json.loads(body)
            if change["restarted"]:
                self.scene, self._unstable = change, None
            else:
                self.scene.update(change)
        elif letters == b"STOP":
            stop = json.loads(body)
            if stop["reason"] == "unstable":
                self._unstable = stop["time"], stop["particle"], stop["stage"], stop["law"]
        elif letters == b"FRAM":
            self.frame = self._frame_of(body)

    def _frame_of(self, body):
        number = struct.unpack_from("<I", body, 4)[0]
        time, _, distance = struct.unpack_from("<3d", body, 16)
        values, at = np.frombuffer(body, "<f4", offset=72), self.actuators
        drive, count, arrays = values[:at], self.scene["particles"], {}
        for field, width in (("position", 3), ("velocity", 3), ("density", 1)):
            if field in self.scene["fields"]:
                part = values[at:at + width * count]
                arrays[field], at = part.reshape(count, 3) if width == 3 else part, at + width * count
        return Frame(number, time, distance, drive, arrays.get("position"), arrays.get("velocity"), arrays.get("density"))
