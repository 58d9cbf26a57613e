"""Many swims side by side in one program, through `natator-sim stream --batch` (sim-native/protocol/stream.md)."""

import collections
import itertools
import json
import os
import struct

import numpy as np

from natator.errors import InputError, ProgramError
from natator.gait import rows, whole
from natator.plain import line
from natator.program import PATIENCE, stop
from natator.stream import LARGEST, MAX_COMMAND, Senses, Stream, start_program

NOBODY = 2**32 - 1
STAND_STILL, GO_ON, DRIVE, STEER = range(4)
STEPPED, UNSTABLE, REFUSED = 1, 2, 3
MAX_SWIMS = 4096


class Batch:
    """Swims of a scene, each with its own actions, start and settings; what one does has no part in another's bits.

    count: how many. threads: how many go on at a time, by default as many as there are processors. Other arguments are those of
    Stream. A context manager; what nobody closes or refers to is closed too. Raises InputError and ProgramError.

    Attribute: `swims`, a list of BatchStream, each of which does what a Stream does. Steps that are begun by `begin_step` of several
    swims are simulated together when the first of them is ended by `end_step`.
    """

    def __init__(self, scene, count, threads=None, arguments=(), **options):
        count, processors = whole("count", count, 1), len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
        if count > MAX_SWIMS:
            raise InputError(f"count = {count}: must be at most {MAX_SWIMS}")
        threads = min(processors, count) if threads is None else whole("threads", threads, 1)
        self._program, framed = start_program(scene, arguments=[*arguments, f"--batch={count}", f"--threads={threads}"], **options)
        self._turns, self._heard, self._speaker = itertools.count(1), collections.deque(), NOBODY if count > 1 else 0
        self._asked, self._torn = {}, False
        self.swims = [BatchStream(self, index, framed) for index in range(count)]
        try:
            for swim in self.swims:
                swim.meet()
        except BaseException:
            self.close()
            raise

    def close(self):
        """Ends what is under way, too."""
        stop([self._program], 0 if self._is_busy() else PATIENCE)

    def _is_busy(self):
        """Whether an answer is still to come."""
        return self._torn or bool(self._asked) or any(swim._unanswered for swim in self.swims)

    def is_lost(self):
        """Whether its program has ended, though nobody closed it, or a call was interrupted before its answer was read."""
        return not self._program.is_closed() and (self._program.has_ended() or self._is_busy())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def act(self):
        """Simulates the steps that have been begun, all of them together; each swim then has what came of its own."""
        asked, self._asked, parts = self._asked, {}, []
        for index in range(len(self.swims)):
            kind, frames, values = asked.get(index, (STAND_STILL, 0, NO_VALUES))
            parts += [struct.pack("<4I", kind, frames, *values.shape), values.astype("<f8").tobytes()]
        told, refusals = self._outcomes(self._ask(parts))
        for index in asked:
            self.swims[index].outcome = *told[index], refusals.get(index, "")

    def _outcomes(self, body):
        """Status and senses of each in an OBSV, and why those that are refused are, by number."""
        try:
            at, told = 0, []
            for _ in self.swims:
                status, size = struct.unpack_from("<II", body, at)
                told.append((status, np.frombuffer(body, "<f8", size, at + 8)))
                at += 8 + 8 * size
        except (ValueError, struct.error):
            raise self._program.no_simulator() from None
        return told, self._refusals(body[at:])

    def _refusals(self, text):
        try:
            return {int(index): str(why) for index, why in json.loads(text).items()}
        except (AttributeError, ValueError):
            raise self._program.no_simulator() from None

    def _ask(self, parts):
        """Sends an ACTS of these parts; returns the OBSV behind its head."""
        turn, count = next(self._turns) % NOBODY, len(self.swims)
        body = struct.pack("<II", turn, count) + b"".join(parts)
        self._torn = True
        self._program.send(struct.pack("<4sI", b"ACTS", len(body)) + body)
        while (heard := self.hear()) is None:
            pass
        self._torn = False
        try:
            if struct.unpack_from("<II", heard) != (turn, count):
                raise ValueError
            return heard[8:]
        except (ValueError, struct.error):
            raise self._program.no_simulator() from None

    def step(self, values, which, kind=DRIVE):
        """Simulates steps of those swims that `which` (booleans, one for each) names, all of them together. values: swims × frames ×
        columns, drives or, with kind STEER, scales and offsets. Returns what came of each, STEPPED or UNSTABLE, 0 for the
        others, and its senses, a row of numbers for each (Senses.from_numbers). All must have as many. Raises InputError, and those that
        are not named in it have stepped."""
        if self._is_busy():
            raise self._program.unread("a step was begun, or a call interrupted, before its answer was read")
        for swim in itertools.compress(self.swims, which):
            if swim._framed:
                swim.send({"do": "credit"})
        count, frames, columns = values.shape
        told = np.zeros(count, np.dtype([("head", "<u4", 4), ("values", "<f8", (frames, columns))]))
        told["head"], told["values"] = (kind, frames, frames, columns), values
        still = struct.pack("<4I", STAND_STILL, 0, 0, 0)
        parts = [told.tobytes()] if np.all(which) else [one.tobytes() if go else still for one, go in zip(told, which)]
        body = self._ask(parts)
        try:
            row = np.dtype([("status", "<u4"), ("size", "<u4"), ("senses", "<f8", struct.unpack_from("<I", body, 4))])
            found = np.frombuffer(body, row, count)
            alike = np.all(found["size"] == found["size"][0])
        except (ValueError, struct.error):
            alike = False
        if alike:
            told, refusals = (found["status"], found["senses"]), self._refusals(body[count * row.itemsize:])
        else:
            all_told, refusals = self._outcomes(body)
            told = tuple(zip(*all_told))
        for swim, status in itertools.compress(zip(self.swims, told[0]), which):
            if swim._framed or status != STEPPED:
                swim.take_heard()
        for index, why in refusals.items():
            raise InputError(f"swim {index}: {why}")
        for index, senses in enumerate(() if alike else told[1]):
            if len(senses) != len(told[1][0]):
                raise InputError(f"swim {index}: senses are {len(senses)} numbers: must be {len(told[1][0])}, as those of swim 0")
        return told

    def hear(self):
        """Reads a message, which goes to its swim; returns that of all of them, if it is one."""
        letters, size = struct.unpack("<4sI", self._program.peek(8))
        if size % 4 or size > LARGEST.get(letters, -1):
            raise self._program.no_simulator()
        body = self._program.read(8 + size)[8:]
        if letters == b"SWIM" and size == 4:
            self._speaker, = struct.unpack("<I", body)
        elif self._speaker < len(self.swims) and letters not in (b"SWIM", b"OBSV"):
            self.swims[self._speaker].heard.append((letters, body))
        elif letters == b"OBSV" and (self._speaker == NOBODY or len(self.swims) == 1):
            return body
        else:
            raise self._program.no_simulator()
        return None


class BatchStream(Stream):
    """One of a Batch. Closing it does nothing: that is the batch's."""

    _alone = False

    def __init__(self, batch, index, framed):
        self.batch, self.index, self.heard, self.outcome = batch, index, collections.deque(), None
        self._begin(batch._program, framed)

    def meet(self):
        """Takes what it is told at first."""
        self._take(*self._message())
        self.take_first_frame()

    def close(self):
        """Does nothing."""

    def send(self, command):
        """Sends a command without waiting for its answer."""
        if len(line({**command, "id": 2**53 - 1, "swim": self.index})) > MAX_COMMAND:
            raise InputError("command: longer than 1 MiB")
        super().send({**command, "swim": self.index})

    def require_idle(self):
        """Raises ProgramError if an answer is still to come."""
        super().require_idle()
        if self.batch._torn or self.index in self.batch._asked:
            raise self._program.unread("a step was begun, or a call interrupted, before its answer was read")

    def begin_step(self, frames=None, drive=None, scale=None, offset=None, swimmer=None):
        """Keeps a step for the moment when it, or one of another swim, is ended. Without `swimmer`: values are of the first or of all."""
        if swimmer is not None:
            raise InputError("swimmer: must be left out in a batch, whose steps are for the first swimmer or for all")
        if self.index in self.batch._asked:
            raise ProgramError("a step was begun before: end it first")
        kind, values = GO_ON, NO_VALUES
        if drive is not None and (scale is not None or offset is not None):
            raise InputError("drive: must not be given together with scale or offset")
        if drive is not None:
            kind, values = DRIVE, np.atleast_2d(rows("drive", drive))
        elif scale is not None or offset is not None:
            given = [None if one is None else np.atleast_2d(rows(name, one)) for name, one in (("scale", scale), ("offset", offset))]
            width = given[scale is None].shape[-1]
            given = [np.full((1, width), rest) if one is None else one for one, rest in zip(given, (1.0, 0.0))]
            length = max(len(one) for one in given)
            if any(len(one) not in (1, length) for one in given):
                raise InputError(f"scale has {len(given[0])} rows, offset {len(given[1])}: must have as many, or one for all frames")
            kind, values = STEER, np.hstack([np.repeat(one, length, axis=0) if len(one) == 1 else one for one in given])
        count = len(values) if frames is None and len(values) else whole("frames", 1 if frames is None else frames, 1)
        if self._framed:
            self.send({"do": "credit"})
        self.batch._asked[self.index] = kind, count, values

    def end_step(self):
        """The senses at the end of a step that was begun. Raises Unstable."""
        if self.index in self.batch._asked:
            self.batch.act()
        self.take_heard()
        (status, values, refusal), self.outcome = self.outcome, None
        if status == REFUSED:
            raise InputError(refusal)
        if status not in (STEPPED, UNSTABLE):
            raise self._program.no_simulator()
        self.require_stable()
        try:
            return Senses.from_numbers(values, self.all_actuators)
        except ValueError:
            raise self._program.no_simulator() from None

    def take_heard(self):
        """What has been told beside the outcome of a step, with the answer to the credit that it was given."""
        if self._framed:
            self.receive()
        while self.heard:
            self._take(*self.heard.popleft())

    def _message(self):
        while not self.heard:
            if self.batch.hear() is not None:
                raise self._program.no_simulator()
        return self.heard.popleft()


NO_VALUES = np.zeros((0, 0))
