"""A swimmer that a program drives, through `natator-sim stream` (sim-native/protocol/stream.md)."""

import collections
import itertools
import json
import os
import struct
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from natator import program as programs
from natator.errors import InputError, ProgramError, Unstable
from natator.gait import Gait, numbers, rows, whole
from natator.plain import is_number, is_whole, line, plain
from natator.water import Water

SIDES = ("left", "right", "above", "below")


def pairs(name, values):
    """A list of pairs, from any sequence of pairs."""
    try:
        return [(first, second) for first, second in values]
    except (TypeError, ValueError):
        raise InputError(f"{name} = {values!r}: must be pairs of two values each") from None


@dataclass(frozen=True)
class Senses:
    """What a swimmer knows of itself and of the water. Own axes are forward, up and right of the body. Of several swimmers
    each array has one row for each, and each number is an array."""

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
    companions: tuple = ()    #: the Senses of each companion

    @classmethod
    def from_json(cls, senses, actuators):
        """actuators: how many each swimmer has. Raises ValueError, TypeError, KeyError or AttributeError for what is none."""
        actuators, *others = actuators
        companions = senses.get("companions", [])
        if len(companions) != len(others):
            raise ValueError
        flow, target = senses.get("flow", []), senses.get("target", {"direction": None, "distance": None})
        if not (is_whole(senses["frame"]) and isinstance(senses["touchesPlane"], bool)):
            raise ValueError
        return cls(
            senses["frame"], _number(senses["time"]), _number(senses["distance"]), senses["touchesPlane"],
            _number(senses.get("work")),
            *(_vector(senses[key], 3) for key in ("centre", "forward", "up", "right", "velocity", "turnRate")),
            *(_vector(senses[key], actuators) for key in ("drive", "bend")),
            np.array([_vector(place["velocity"], 3) for place in flow]).reshape(-1, 3),
            np.array([place["particles"] if is_whole(place["particles"]) else None for place in flow], int),
            _vector(target["direction"] or [None] * 3, 3), _number(target["distance"]),
            tuple(cls.from_json(one, [count]) for one, count in zip(companions, others)))

    @classmethod
    def from_numbers(cls, values, actuators):
        """From those of an OBSV, or rows of them. actuators: how many each swimmer has. Raises ValueError where they are too few."""
        if len(actuators) > 1:
            sizes = values.reshape(-1, values.shape[-1])[0, -len(actuators):].astype(int)
            if sizes.min() < 0 or sizes.sum() + len(sizes) != values.shape[-1]:
                raise ValueError
            parts = np.split(values[..., :-len(sizes)], np.cumsum(sizes)[:-1], axis=-1)
            first, *companions = (cls.from_numbers(part, [count]) for part, count in zip(parts, actuators))
            return replace(first, companions=tuple(companions))
        actuators, = actuators
        places, rest = divmod(values.shape[-1] - 27 - 2 * actuators, 4)
        if places < 0 or rest:
            raise ValueError
        ends = np.cumsum([5, 3, 3, 3, 3, 3, 3, 3, 1, actuators, actuators, 3 * places])
        head, *vectors, distance, drive, bend, flow, particles = np.split(values, ends, axis=-1)
        centre, forward, up, right, velocity, turn_rate, target = vectors
        frame, touches = head[..., 0].astype(int), head[..., 3].astype(bool)
        numbers = frame, head[..., 1], head[..., 2], touches, head[..., 4], distance[..., 0]
        frame, time, way, touches, work, distance = (one.item() for one in numbers) if values.ndim == 1 else numbers
        return cls(frame, time, way, touches, work, centre, forward, up, right, velocity, turn_rate, drive, bend,
                   flow.reshape(*flow.shape[:-1], places, 3), particles.astype(int), target, distance)

    def numbers(self):
        """Those of an OBSV, in its order."""
        if self.companions:
            parts = [one.numbers() for one in (replace(self, companions=()), *self.companions)]
            return np.concatenate([*parts, [len(part) for part in parts]])
        return np.concatenate([[self.frame, self.time, self.distance, self.touches_plane, self.work], self.centre, self.forward, self.up,
                               self.right, self.velocity, self.turn_rate, self.target, [self.target_distance], self.drive, self.bend,
                               self.flow.ravel(), self.flow_particles])


def _number(value):
    """A number of a message; nan for null."""
    if value is not None and not is_number(value):
        raise ValueError
    return np.nan if value is None else value


def _vector(values, size):
    """A list of `size` numbers as an array. Raises ValueError for anything else."""
    if not isinstance(values, list) or len(values) != size:
        raise ValueError
    return np.array([_number(value) for value in values], float)


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
    force: np.ndarray = None  #: N × 3, of the water over the frame, mass length/s²; 0 in the settled start, and on water


class Stream:
    """A scene that stands still until it is told to step: the same commands give the same bits.

    scene: name or path. gait, overrides (a dict merged into the scene), scheme, start (an int: which of its many starts):
    as in a request. fields: what frames hold of each particle, of "position", "velocity", "density", "force" (not in scheme flex); without any there are
    no frames. backend: "cpu", "cuda" or "auto". arguments: a list of more arguments of `natator-sim stream`. A context manager; what nobody closes or refers to
    is closed too. A forked process needs its own. Raises InputError and ProgramError.

    A scene's companions are swimmers, too: `swimmer`, here and there, is 0 for the first, which it is by default, then 1 and so on.

    Attributes: `scene`, the SCEN message as a dict (particles, body, slices, bodyLength, actuators …); `frame`, the last
    Frame, None without fields; `last_water`, the Water that was asked for last.
    """

    _alone = True  # in its program

    def __init__(self, scene, gait=None, overrides=None, scheme=None, start=None, fields=(), arguments=(), program=None,
                 backend=None):
        self._begin(*start_program(scene, gait, overrides, scheme, start, fields, arguments, program, backend))
        try:
            self._take(*self._message())
            if "force" in fields and "force" not in self.scene["fields"]:
                raise InputError(f"fields: scheme {self.scene.get('scheme')} knows no force; must be conserving or lattice")
            self.take_first_frame()
        except BaseException:
            self.close()
            raise

    def _begin(self, program, framed):
        self.scene, self.frame, self.last_water, self._state = {}, None, None, None
        self._framed, self._program = framed, program
        self._unstable, self._torn = None, False
        self._ids, self._unanswered = itertools.count(1), collections.deque()

    @property
    def actuators(self):
        """Their number."""
        return self.scene["actuators"]

    @property
    def swimmers(self):
        """What the SCEN message has of each: body, slices, bodyLength, joints, actuators, muscles, gait. The first is the message."""
        return [self.scene, *(self.scene.get("companions") or [])]

    @property
    def all_actuators(self):
        """How many each swimmer has."""
        return [swimmer["actuators"] for swimmer in self.swimmers]

    def sense(self, flow=None, within=None, target=None, **more):
        """Says what is to be sensed from now on, and gives the senses now. more: `swimmer`, whose they are. flow: places of the skin as (slice, side), side
        one of "left", "right", "above", "below"; within: of a place water counts, length; target: where the swimmer shall
        go, length. What is left out stays as it was."""
        self.require_idle()
        self.begin_sense(flow, within, target, **more)
        return self.end_sense()

    def begin_sense(self, flow=None, within=None, target=None, **more):
        """Sends a `sense` without waiting for its answer."""
        places = None if flow is None else [{"slice": whole(f"flow[{i}].slice", place, 0), "side": side}
                                            for i, (place, side) in enumerate(pairs("flow", flow))]
        command = {"do": "sense", "target": None if target is None else numbers("target", target), "within": within,
                   "flow": places, **more, **_of_swimmer(more.get("swimmer"))}
        self.send({key: value for key, value in command.items() if value is not None})

    def end_sense(self):
        """Waits for it; returns the senses."""
        return self._senses(self.receive())

    def step(self, frames=None, drive=None, scale=None, offset=None, swimmer=None):
        """Simulates frames; the senses at the end. drive: a value in [-2, 2] for each actuator, or a row of them for each
        frame, in place of the gait; scale, offset: what the gait gives, times scale plus offset, likewise. They stay until changed.
        Values are those of the first swimmer, or of `swimmer`, or of all, one after the other.
        Raises InputError, and then nothing was simulated; raises Unstable."""
        self.require_idle()
        self.begin_step(frames, drive, scale, offset, swimmer)
        return self.end_step()

    def begin_step(self, frames=None, drive=None, scale=None, offset=None, swimmer=None):
        """Sends a `step` without waiting for its answer. Several may be begun before the first is ended."""
        command = {"do": "step", "sense": True}
        if frames is not None:
            command["frames"] = whole("frames", frames, 1)
        if drive is not None:
            command["drive"] = rows("drive", drive).tolist()
        for name, values in (("scale", scale), ("offset", offset)):
            if values is not None:
                command[name] = rows(name, values).tolist()
        command |= _of_swimmer(swimmer)
        if self._framed:
            self.send({"do": "credit"})
        self.send(command)

    def end_step(self):
        """Waits for a step that `begin_step` sent; returns the senses at its end. Raises Unstable."""
        if self._framed:
            self.receive()
        return self._senses(self.receive())

    def save(self):
        """The present moment as bytes, which any process may go on from: all that what follows depends on. Raises InputError when the
        simulation has become unstable."""
        self.ask({"do": "save"})
        return self._state

    def restore(self, state, bodies=None):
        """Goes to a moment that `save` gave, of the same scene; its overrides, start and gait come with it, and what is sensed
        stays. bodies: what each swimmer must have there, {"actuators": A, "slices": at least S}. Returns the senses. Raises InputError
        for others, and for bytes that are damaged, or of another scene, scheme, precision or version; then nothing has changed."""
        if not isinstance(state, (bytes, bytearray, memoryview)):
            raise InputError(f"state = {state!r}: must be bytes, as save gives them")
        self.require_idle()
        if state is not self._state or not self._alone:  # which the simulator has
            self._send_message(b"STAT", bytes(state))
            self._state = state if isinstance(state, bytes) else None
        senses = len(self.scene["body"]) > 0
        if self._framed:
            self.send({"do": "credit"})
        self.send({"do": "restore", "sense": senses, **({} if bodies is None else {"bodies": bodies})})
        if self._framed:
            self.receive()
        answer = self.receive()
        self._unstable = None
        return self._senses(answer) if senses else None

    def water(self):
        """The Water as it is now. Raises InputError, also when the simulation has become unstable."""
        self.ask(self.water_command)
        return self.last_water

    @property
    def water_command(self):
        """What asks for it, with its pressure where that is known."""
        return {"do": "water", "pressure": self.scene.get("scheme") != "flex"}

    def steer(self, scale=None, offset=None, swimmer=None):
        """Scales and offsets the gait from the next frame on, of the swimmers that `step` tells; without arguments the gait alone drives
        again."""
        self.ask({"do": "steer", **_of_swimmer(swimmer), **{name: numbers(name, values) for name, values in (("scale", scale), ("offset", offset))
                                    if values is not None}})

    def set_gait(self, gait, swimmer=None):
        """From the next frame on."""
        self.ask({"do": "gait", "gait": gait, **_of_swimmer(swimmer)})

    def reset(self, start=None):
        """Back to the settled start, or to another of the scene's starts; what is sensed stays."""
        self.require_idle()
        self.begin_reset(start)
        self.end_reset()

    def begin_reset(self, start=None):
        """Sends a `reset` without waiting for it."""
        self.send({"do": "reset"} if start is None else {"do": "reset", "start": whole("start", start, 0)})

    def end_reset(self):
        """Waits for a reset that `begin_reset` sent."""
        self.receive()
        self.take_first_frame()

    def ask(self, command):
        """Sends any command of the protocol; returns its answer. Raises InputError."""
        self.require_idle()
        self.send(command)
        return self.receive()

    def require_idle(self):
        """Raises ProgramError if an answer is still to come: a call was interrupted, and all later answers would be taken for
        others."""
        if self._torn or self._unanswered:
            raise self._program.unread("a call was interrupted before its answer was read: close the stream and open another")

    def _send_message(self, letters, body):
        """Sends bytes among the commands."""
        self._program.require_open()
        if len(body) > LARGEST[letters]:
            raise InputError(f"{len(body)} bytes: must be at most {LARGEST[letters]}")
        self._torn = True
        self._program.send(struct.pack("<4sI", letters, len(body)) + body)
        self._torn = False

    def send(self, command):
        """Sends a command without waiting for its answer."""
        self._program.require_open()
        command = {"id": next(self._ids), **command}
        text, self._torn = line(command), True
        self._program.send(text)
        self._unanswered.append(command["id"])
        self._torn = False

    def receive(self):
        """The answer to the first command that has none yet. Raises InputError."""
        if not self._unanswered:
            raise ProgramError("there is no answer to come: nothing was asked")
        while True:
            letters, body = self._message()
            if letters != b"ANSW":
                self._take(letters, body)
                continue
            answer, own = self._program.json(body), self._unanswered.popleft()
            refused = isinstance(answer.get("error"), str)
            named = answer.get("id") == own or refused and answer.get("id") is None  # of what is too damaged to tell whose it is
            if not named or not refused and answer.get("ok") is not True:
                raise self._program.no_simulator()
            if refused:
                raise InputError(answer["error"])
            return answer

    def close(self):
        """Ends what is under way, too."""
        close_all([self])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def require_stable(self):
        """Raises Unstable if the simulation has stopped so."""
        if self._unstable:
            raise Unstable(*self._unstable)

    def no_simulator(self):
        """The error of a program that answers as none of ours does, which is ended."""
        return self._program.no_simulator()

    def _senses(self, answer):
        self.require_stable()
        try:
            return Senses.from_json(answer["senses"], self.all_actuators)
        except (AttributeError, KeyError, OverflowError, TypeError, ValueError):
            raise self._program.no_simulator() from None

    def take_first_frame(self):
        """Takes the settled start, which waits for credit."""
        if not self._framed or self._unstable:
            return
        self.ask({"do": "credit"})
        letters = None
        while letters != b"FRAM" and not self._unstable:  # which is told before the answer
            letters, body = self._message()
            if letters not in (b"SENS", b"FRAM"):
                raise self._program.no_simulator()
            self._take(letters, body)

    def _message(self):
        letters, size = struct.unpack("<4sI", self._program.peek(8))
        if size % 4 or size > LARGEST.get(letters, -1):
            raise self._program.no_simulator()
        return letters, self._program.read(8 + size)[8:]

    def _take(self, letters, body):
        if letters == b"FRAM":
            self.frame = self._frame_of(body)
        elif letters == b"WATR":
            try:
                self.last_water = Water.from_message(body)
            except ValueError:
                raise self._program.no_simulator() from None
        elif letters == b"STAT":
            self._state = body
        elif letters == b"SCEN":
            self._take_scene(self._program.json(body))
        elif letters == b"STOP":
            stop = self._program.json(body)
            if stop.get("reason") == "unstable":
                self._unstable = tuple(stop.get(key) for key in ("time", "particle", "stage", "law"))
                if not (is_number(self._unstable[0]) and is_whole(self._unstable[1]) and all(isinstance(text, str) for text in self._unstable[2:])):
                    raise self._program.no_simulator()

    def _take_scene(self, change):
        if change.get("restarted") is True and is_whole(change.get("protocol")) and change["protocol"] != PROTOCOL:
            self.close()
            raise ProgramError(f"{self._program.path} speaks protocol {change['protocol']}: must be {PROTOCOL}, as this client does")
        scene = change if change.get("restarted") is True else {**self.scene, **change}
        if not isinstance(change.get("restarted"), bool) or not _is_scene(scene):
            raise self._program.no_simulator()
        if change["restarted"]:
            self.scene, self._unstable = scene, None
        else:
            self.scene.update(change)

    def _frame_of(self, body):
        at = self.scene.get("actuators", 0)
        widths = {field: WIDTHS[field] for field in self.scene.get("fields", ())}
        if len(body) != 72 + 4 * (at + sum(widths.values()) * self.scene.get("particles", 0)):
            raise self._program.no_simulator()
        number = struct.unpack_from("<I", body, 4)[0]
        time, _, distance = struct.unpack_from("<3d", body, 16)
        values = np.frombuffer(body, "<f4", offset=72)
        drive, count, arrays = values[:at], self.scene["particles"], {}
        for field, width in widths.items():
            part = values[at:at + width * count]
            arrays[field], at = part.reshape(count, 3) if width == 3 else part, at + width * count
        return Frame(number, time, distance, drive, arrays.get("position"), arrays.get("velocity"), arrays.get("density"),
                     arrays.get("force"))


def _of_swimmer(swimmer):
    """The key of a command that is for one of several."""
    return {} if swimmer is None else {"swimmer": whole("swimmer", swimmer, 0)}


def start_program(scene, gait=None, overrides=None, scheme=None, start=None, fields=(), arguments=(), program=None, backend=None):
    """A program that streams, and whether it gives frames. Arguments are those of Stream."""
    fields = [fields] * bool(fields) if isinstance(fields, str) else programs.listed("fields", fields)
    arguments = programs.listed("arguments", arguments)
    if not isinstance(scene, (str, os.PathLike)):
        raise InputError(f"scene = {scene!r}: must be a name or a path")
    for i, field in enumerate(fields):
        if not isinstance(field, str) or not field:
            raise InputError(f"fields[{i}] = {field!r}: must be a text, not empty")
    scene = os.fsdecode(scene)
    options = ["stream", "./" * scene.startswith("-") + scene,  # a file, not an option
               "--paused", "--fields=" + (",".join(fields) or "none")]
    for name, value in (("--gait", gait), ("--overrides", overrides)):
        if value is None:
            continue
        if not isinstance(value, (Mapping, Gait)):
            raise InputError(f"{name.removeprefix('--')} = {value!r}: must be a dict" + " or a Gait" * (name == "--gait"))
        options.append(f"{name}={json.dumps(plain(name.removeprefix('--'), value))}")
    options += [f"--{name}={value}" for name, value in (("scheme", scheme), ("backend", backend)) if value is not None]
    if start is not None:
        options.append(f"--start={whole('start', start, 0)}")
    return programs.Program(program, [*options, *arguments]), bool(fields)


def close_all(streams):
    """Closes streams at the same time."""
    busy = any(stream._torn or stream._unanswered for stream in streams)
    programs.stop([stream._program for stream in streams], 0 if busy else programs.PATIENCE)


def _is_scene(scene):
    """Whether a SCEN message has what this package reads of it."""
    def listed(value, check):
        return isinstance(value, list) and all(check(part) for part in value)

    def muscle(value):
        return isinstance(value, dict) and is_whole(value.get("actuator")) and value["actuator"] < scene["actuators"]

    def index(value):
        return is_whole(value) and value < scene["particles"]

    def companion(value):
        return (isinstance(value, dict) and is_whole(value["actuators"]) and is_number(value["bodyLength"]) and value["bodyLength"] > 0
                and listed(value["body"], index) and listed(value["slices"], lambda slice_: listed(slice_, index)))

    try:
        tank = scene["definition"].get("movingTank") or {}
        return (isinstance(scene["scene"], str) and isinstance(tank.get("along", ""), str)
                and is_whole(scene["actuators"]) and is_whole(scene["particles"])
                and is_number(scene["timeStep"]) and scene["timeStep"] > 0 and is_number(scene["bodyLength"])
                and (scene["bodyLength"] > 0 or scene["actuators"] == 0)
                and listed(scene["fields"], WIDTHS.__contains__) and listed(scene["body"], index)
                and listed(scene["slices"], lambda slice_: listed(slice_, index)) and listed(scene["muscles"], muscle)
                and len({one["actuator"] for one in scene["muscles"]}) == scene["actuators"]
                and listed(scene.get("companions") or [], companion)
                and listed(scene["planes"], lambda plane: listed(plane, is_number) and len(plane) == 4)
                and listed(scene["fluid"], is_whole) and len(scene["fluid"]) == 2
                and sum(scene["fluid"]) <= scene["particles"])
    except (AttributeError, KeyError, TypeError):
        return False


PROTOCOL = 2
MAX_COMMAND = 1 << 20  # bytes of a line
WIDTHS = {"position": 3, "velocity": 3, "density": 1, "force": 3}
#: bytes of a message's body
LARGEST = {b"SCEN": 1 << 30, b"FRAM": 1 << 30, b"WATR": 1 << 31, b"STAT": 1 << 30,
           b"ACTS": 1 << 30, b"OBSV": 1 << 30, b"SWIM": 4, b"ANSW": 1 << 24, b"SENS": 1 << 24, b"STOP": 1 << 16}
