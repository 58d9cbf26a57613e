"""Evaluations through `natator-sim serve`."""

import itertools
import os
import threading
from collections.abc import Iterable, Mapping

from natator import program as programs
from natator.errors import InputError, ProgramError
from natator.gait import as_json, whole
from natator.plain import is_number, is_whole, line


class Simulator:
    """Keeps programs that evaluate requests, one for each worker; each is single-threaded.

    workers: how many at a time, from 1, by default as many as there are processors. With --backend cuda one worker does, which
    computes what it is given together. arguments: a list of more arguments of `natator-sim serve`. Threads may share one: they
    take turns; a forked process needs its own. A context manager; what nobody closes or refers to is closed too. Raises
    InputError and ProgramError.
    """

    def __init__(self, workers=None, arguments=(), program=None):
        count = whole("workers", workers, 1) if workers is not None else _processors()
        arguments = programs.listed("arguments", arguments)
        self._programs, self._ids = [], itertools.count()
        self._turn = threading.RLock()
        try:
            for _ in range(count):
                self._programs.append(programs.Program(program, ["serve", *arguments]))
        except BaseException:
            self.close()
            raise

    def evaluate(self, scene, gait=None, **request):
        """The result of one gait, a dict as result.schema.json describes it. `request`: more of its fields, such as
        duration, scheme, start, overrides. Raises InputError for a request that can't be used; an unstable simulation is a
        result, with status "unstable" and fitness 0."""
        return self.evaluate_all([make_request(scene, gait, **request)])[0]

    def evaluate_all(self, requests):
        """Results of many requests (make_request, or dicts as request.schema.json describes them), in their order. What
        one request gives does not depend on the others, nor on the number of workers. Raises InputError for the first that
        can't be used: when all are done, or at once where JSON has no form for it. A simulator that is interrupted is closed."""
        requests = _mappings(requests)
        lines = {}
        for number, request in enumerate(requests):
            own = next(self._ids)  # of no other request: what was said to another is not taken for its answer
            lines[own] = line(dict(request, id=own), f"requests[{number}]" if len(requests) > 1 else "")
        self._require_open()
        with self._turn:
            self._require_open()
            answers = self._answers(lines)
        for number, answer in enumerate(answers):
            if answer["status"] == "error":
                raise InputError((f"requests[{number}]: " if len(requests) > 1 else "") + answer["error"])
            answer["id"] = number
        return answers

    def _require_open(self):
        if not self._programs:
            raise ProgramError("the simulator is closed")
        self._programs[0].require_open()

    def _answers(self, lines):
        """The answers to these lines, in their order, matched by id."""
        ids, shares, answers = list(lines), {}, {}
        for k, program in enumerate(self._programs):
            if mine := ids[k::len(self._programs)]:
                shares[program] = _Share(program, mine)
        try:
            for program, share in shares.items():
                program.send_later(b"".join(lines[own] for own in share.left))
            while shares:
                programs.exchange(list(shares))
                for program, share in list(shares.items()):
                    if share.take():
                        answers |= shares.pop(program).answers
        except BaseException:
            self._end(patience=0)  # what was not read would be the answers to the next requests
            raise
        return [answers[own] for own in ids]

    def close(self):
        """Ends the programs. A thread that waits for answers meanwhile gets a ProgramError."""
        idle = self._turn.acquire(blocking=False)
        try:
            self._end(programs.PATIENCE if idle else 0)
        finally:
            if idle:
                self._turn.release()

    def _end(self, patience):
        ended, self._programs = self._programs, []
        programs.stop(ended, patience)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def make_request(scene, gait=None, **request):
    """A request of `natator-sim serve`, as a dict. Arguments that are None are left out."""
    given = dict(request, scene=scene, gait=None if gait is None else as_json(gait))
    return {key: value for key, value in given.items() if value is not None}


def evaluate(scene, gait=None, program=None, **request):
    """Evaluates one gait, as `Simulator.evaluate` does, in a program started for it."""
    with Simulator(workers=1, program=program) as simulator:
        return simulator.evaluate(scene, gait, **request)


def _mappings(requests):
    """Requests as a list. Raises InputError for anything that is not a request."""
    if isinstance(requests, (Mapping, str)) or not isinstance(requests, Iterable):
        raise InputError(f"requests = {requests!r}: must be a list of dicts")
    requests = list(requests)
    for number, request in enumerate(requests):
        if not isinstance(request, Mapping):
            raise InputError(f"requests[{number}] = {request!r}: must be a dict")
    return requests


def _processors():
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()


class _Share:
    """The requests to one program, and its answers."""

    def __init__(self, program, ids):
        self.answers = {}
        self.left, self._program, self._unnamed = dict.fromkeys(ids), program, []

    def take(self):
        """Takes the answers that have arrived; returns whether all have."""
        while len(self._unnamed) < len(self.left):
            text = self._program.line()
            if text is None:
                return False
            answer = self._program.json(text)
            if not _is_answer(answer) or answer["id"] is not None and answer["id"] not in self.left:
                raise self._program.no_simulator()
            if answer["id"] is None:
                self._unnamed.append(answer)
            else:
                del self.left[answer["id"]]
                self.answers[answer["id"]] = answer
        self.answers |= zip(self.left, self._unnamed)  # of requests too damaged to tell whose they are
        return True


def _is_answer(answer):
    """Whether a dict has the keys that result.schema.json requires."""
    own, status = answer.get("id", ""), answer.get("status")
    if status == "error":
        return isinstance(answer.get("error"), str) and (own is None or is_whole(own))
    return (status in ("ok", "unstable") and is_whole(own) and is_number(answer.get("fitness"))
            and (is_number(answer.get("distance")) if status == "ok" else answer.get("distance", 0) is None)
            and is_number(answer.get("simulated")) and is_whole(answer.get("frames"))
            and all(isinstance(answer.get(key), str) for key in ("stopped", "scheme", "precision"))
            and (isinstance(answer.get("hash"), str) if status == "ok" else isinstance(answer.get("unstable"), dict)))
