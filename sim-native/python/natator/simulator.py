"""Evaluations through `natator-sim serve`."""

import json
import os
import threading
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor

from natator import program as programs
from natator.errors import InputError, ProgramError
from natator.gait import as_json, whole
from natator.plain import line


class Simulator:
    """Keeps programs that evaluate requests, one for each worker; each is single-threaded.

    workers: how many at a time, from 1, by default as many as there are processors. With --backend cuda one worker does, which
    computes what it is given together. arguments: a list of more arguments of `natator-sim serve`. Threads may share one: they
    take turns. To be closed; a context manager. Raises InputError.
    """

    def __init__(self, workers=None, arguments=(), program=None):
        count = whole("workers", workers, 1) if workers is not None else _processors()
        arguments = programs.listed("arguments", arguments)
        self._processes = []
        self._turn = threading.Lock()
        try:
            for _ in range(count):
                self._processes.append(programs.start(program, ["serve", *arguments]))
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
        lines = [line(dict(request, id=number), f"requests[{number}]" if len(requests) > 1 else "")
                 for number, request in enumerate(requests)]
        with self._turn:
            answers = self._answers(lines)
        answers.sort(key=lambda answer: answer["id"])
        for answer in answers:
            if answer["status"] == "error":
                which = f"requests[{answer['id']}]: " if len(requests) > 1 else ""
                raise InputError(which + answer["error"])
        return answers

    def _answers(self, lines):
        """Of all programs, in any order."""
        if not self._processes:
            raise ProgramError("the simulator is closed")
        shares = [lines[k::len(self._processes)] for k in range(len(self._processes))]
        try:
            with ThreadPoolExecutor(len(shares)) as pool:
                return [answer for part in pool.map(_exchange, self._processes, shares) for answer in part]
        except BaseException:
            self._end(patience=0)  # what was not read would be the answers to the next requests
            raise

    def close(self):
        self._end(patience=10)

    def _end(self, patience):
        for process in self._processes:
            programs.stop(process, patience)
        self._processes = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def make_request(scene, gait=None, **request):
    """A request of `natator-sim serve`: what is None is left out."""
    given = dict(request, scene=scene, gait=None if gait is None else as_json(gait))
    return {key: value for key, value in given.items() if value is not None}


def evaluate(scene, gait=None, program=None, **request):
    """Simulator.evaluate by a program of its own."""
    with Simulator(workers=1, program=program) as simulator:
        return simulator.evaluate(scene, gait, **request)


def _mappings(requests):
    """A list of requests. Raises InputError for what is none."""
    if isinstance(requests, (Mapping, str)) or not isinstance(requests, Iterable):
        raise InputError(f"requests = {requests!r}: must be a list of dicts")
    requests = list(requests)
    for number, request in enumerate(requests):
        if not isinstance(request, Mapping):
            raise InputError(f"requests[{number}] = {request!r}: must be a dict")
    return requests


def _processors():
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()


def _exchange(process, lines):
    """Gives a program its requests while it answers: neither waits for the other with a full pipe."""
    with ThreadPoolExecutor(1) as writer:
        written = writer.submit(_write, process, lines)
        answers = [_read(process) for _ in lines]
        written.result()
    return answers


def _write(process, lines):
    try:
        process.stdin.write(b"".join(lines))
        process.stdin.flush()
    except BrokenPipeError:
        pass  # its end is seen by the reader


def _read(process):
    line = process.stdout.readline()
    if not line:
        raise programs.ended(process)
    try:
        answer = json.loads(line)
    except ValueError:
        answer = None
    if not isinstance(answer, dict) or not {"id", "status"} <= answer.keys():
        raise programs.no_simulator(process)
    return answer
