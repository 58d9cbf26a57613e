"""The program natator-sim: how it is started, spoken to and ended."""

import errno
import functools
import json
import os
import re
import select
import shutil
import subprocess
import time
import weakref
from collections.abc import Iterable, Mapping
from pathlib import Path

import natator
from natator.errors import InputError, ProgramError

NAME = "natator-sim: "
BUILD_IT = "build it here: pip install . in a checkout"
WAYS_OUT = {errno.ENOEXEC: f", as a program for another kind of processor; {BUILD_IT}",
            errno.ENOENT: f", as where there is no glibc (musl); {BUILD_IT}",
            errno.EACCES: ": must be executable, on a disk that programs may run from; install the package again"}
PATIENCE = 0.5            # s for a program that has nothing to do, to end with its input
GRACE = 1.0               # s for one that was told to end, or seems to
CHUNK = 1 << 18           # bytes written or read at once
MAX_LINE = 1 << 24  # bytes of a line that has no end
MAX_OUTPUT = 1 << 30  # bytes of standard output that are read before a command is sent
MAX_ERRORS = 1 << 16  # bytes of standard error that are kept
MAX_ERRORS_WITHOUT_OUTPUT = 1 << 24  # bytes of it without any of standard output
MAX_QUOTED = 1000  # letters of it in a message


def simulator_path(program=None):
    """Path of natator-sim: `program`, else $NATATOR_SIM, else the one that came with this package, else that on the PATH, else that
    of the checkout which this package is run from. Raises ProgramError where there is none, or of another version."""
    if program is not None and not isinstance(program, (str, os.PathLike)):
        raise InputError(f"program = {program!r}: must be a path")
    path = program or os.environ.get("NATATOR_SIM")
    if path:
        if "\0" in str(path) or not os.access(path, os.X_OK) or os.path.isdir(path):
            raise _other_program(path)
    else:
        own = [Path(folder, "program/bin/natator-sim") for folder in natator.__path__]
        built = Path(__file__).resolve().parents[3] / "build/release/bin/natator-sim"
        path = next(filter(Path.exists, own), None) or shutil.which("natator-sim") or (built if os.access(built, os.X_OK) else None)
        if not path:
            raise ProgramError("no natator-sim: install the package by pip install . in a checkout, put the folder of the program, "
                               "build/release/bin, on the PATH, or name it by NATATOR_SIM")
    file = os.stat(path)
    version = _version(str(path), file.st_ino, file.st_mtime_ns)
    if version not in (None, natator.__version__):
        raise ProgramError(f"{path} is natator-sim {version}, this package is {natator.__version__}: must be of the same version; install or "
                           "build both again, or name another program by NATATOR_SIM")
    return str(path)


@functools.lru_cache
def _version(path, *_):
    """What a program says of its version; None of one that says none within a second, which its first use will tell."""
    try:
        with subprocess.Popen([path, "--version"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as process:  # not the null device: who writes on it without end is to end
            try:
                poll = select.poll()
                poll.register(process.stdout, select.POLLIN)
                text = os.read(process.stdout.fileno(), 100) if poll.poll(1000 * GRACE) else b""
            finally:
                process.kill()
    except (OSError, ValueError):
        return None
    found = re.match(rb"natator-sim (\d[\w.]*), ", text)
    return found and found[1].decode()


def _other_program(path, wrong=""):
    return ProgramError(f"{_printable(str(path))}{wrong}: must be the program natator-sim (argument `program`, or $NATATOR_SIM)")


def listed(name, values):
    """A list of an argument of this package that is to be one. Raises InputError for what is none, as a single text."""
    if isinstance(values, (str, bytes, Mapping)) or not isinstance(values, Iterable):
        raise InputError(f"{name} = {values!r}: must be a list of texts")
    return list(values)


class Program:
    """A natator-sim with pipes, which one thread writes and reads, so that a signal's exception ends each wait.

    It ends with this object, or with Python, where it was not closed before. It is of the process that started it alone: a
    forked child has none of its pipes. Raises InputError and ProgramError.
    """

    def __init__(self, program, arguments):
        self.path = simulator_path(program)
        self._unsent, self._output, self._searched = memoryview(b""), bytearray(), 0
        self._errors, self._errors_since_output = b"", 0
        self._stdin_closed = self._closed = self._forked = False
        try:
            self._process = subprocess.Popen([self.path, *map(str, arguments)], bufsize=0, stdin=subprocess.PIPE,
                                             stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        except OSError as error:
            kind = InputError if error.errno == errno.E2BIG else ProgramError
            raise kind(f"{self.path}: cannot be started: {error.strerror}{WAYS_OUT.get(error.errno, '')}") from error
        except ValueError as error:
            raise InputError(f"argument of {self.path}: {error}") from error
        self._finalizer = weakref.finalize(self, _drop, self._process)
        self._open = {self._process.stdout, self._process.stderr}
        os.set_blocking(self._process.stdin.fileno(), False)
        _running.add(self)

    def send_later(self, data):
        """What is sent while others are waited for; see `exchange`."""
        self._unsent = memoryview(bytes(self._unsent) + data)

    def send(self, data):
        """Sends all of it. What the program says meanwhile is kept: neither waits for the other with a full pipe."""
        self.send_later(data)
        while self._unsent:
            if self._stdin_closed:
                raise self.ended()
            if len(self._output) > MAX_OUTPUT:
                raise self.no_simulator()
            _wait([self])

    def peek(self, size):
        """The next so many bytes, which stay to be read."""
        while len(self._output) < size:
            exchange([self])
        return bytes(self._output[:size])

    def read(self, size):
        """So many bytes; where a wait is interrupted, none of them."""
        data = self.peek(size)
        self._forget(size)
        return data

    def line(self):
        """The next line, or None if there is no whole one yet."""
        end = self._output.find(b"\n", self._searched)
        if end < 0:
            self._searched = len(self._output)
            if self._searched > MAX_LINE:
                raise self.no_simulator()
            return None
        data = bytes(self._output[:end])
        self._forget(end + 1)
        return data

    def _forget(self, size):
        del self._output[:size]
        self._searched = 0

    def require_open(self):
        """Raises ProgramError where nobody may speak to it any more, or this process never might."""
        if self._forked:
            raise ProgramError("natator-sim was started by the process that this one is forked from: each must start its own")
        if self._closed:
            raise ProgramError("natator-sim is closed")

    def is_closed(self):
        """Whether nobody may speak to it any more."""
        return self._closed

    def has_ended(self):
        """Whether it is not there any more."""
        return self._process.poll() is not None

    def unread(self, why):
        """The error that an answer was not read: that it has ended, or else this text."""
        return ProgramError(why) if self._process.poll() is None else self.ended()

    def ended(self):
        """The error that it has ended with, though it was to go on. What has closed its pipes alone is ended by this."""
        if self._closed:
            return ProgramError("natator-sim is closed")
        until = time.monotonic() + GRACE
        while self._process.stderr in self._open and time.monotonic() < until:
            if not _wait([self], 0.05, only=self._process.stderr) and self._process.poll() is not None:
                break  # another holds its standard error
        try:
            code = self._process.wait(max(until - time.monotonic(), 0))
        except subprocess.TimeoutExpired:
            self._kill()
            return _other_program(self.path, " reads or says no more, and goes on")
        lines = self._errors.decode(errors="replace").split("\n")
        last = next((_printable(text.strip()) for text in reversed(lines) if text.strip()), "")
        if code == 2 and last.startswith(NAME):
            return InputError(last.removeprefix(NAME))
        if "version `GLIBC_" in last:
            return ProgramError(f"{last}: this system's C library is too old for it; {BUILD_IT}")
        return ProgramError(f"natator-sim has ended, exit code {code}" + (f": {last.removeprefix(NAME)}" if last else ""))

    def no_simulator(self):
        """The error of a program that answers as none of ours does, which is ended."""
        self._kill()
        return _other_program(self.path, " answers as no simulator does")

    def _kill(self):
        self._process.kill()
        self._process.wait()

    def json(self, data):
        """A dict that the program has sent as JSON."""
        try:
            value = json.loads(data, parse_constant=_refuse)
        except (ValueError, RecursionError):
            value = None
        if not isinstance(value, dict):
            raise self.no_simulator()
        return value

    def _watched(self):
        """Pipes to wait for, and for what."""
        if not self._stdin_closed:
            yield self._process.stdin, select.POLLOUT if self._unsent else 0
        for pipe in self._open:
            yield pipe, select.POLLIN

    def _move(self, pipe):
        """Writes or reads what a pipe is ready for."""
        if pipe is self._process.stdin:
            try:
                self._unsent = self._unsent[os.write(pipe.fileno(), self._unsent[:CHUNK]):]
            except BlockingIOError:
                pass
            except BrokenPipeError:
                self._stdin_closed = True
            return
        data = os.read(pipe.fileno(), CHUNK)
        if not data:
            self._open.discard(pipe)
        elif pipe is self._process.stdout:
            self._output += data
            self._errors_since_output = 0
        else:
            self._errors = (self._errors + data)[-MAX_ERRORS:]
            self._errors_since_output += len(data)

    def _let_go(self):
        """The process, whose pipes are closed by this."""
        self._closed = True
        _close_pipes(self._process)
        return self._process

    def _leave_to_parent(self):
        """Has no part in it, in a forked child."""
        self._forked = True
        self._finalizer.detach()
        self._let_go().returncode = 0  # which the parent will know


def exchange(programs):
    """Sends what is unsent, and waits until a program has said more. Raises ProgramError or InputError if one will not."""
    for program in programs:
        if program._process.stdout not in program._open:
            raise program.ended()
        if program._errors_since_output > MAX_ERRORS_WITHOUT_OUTPUT:
            raise program.no_simulator()
    closed = [program for program in programs if program._stdin_closed]
    if not _wait(programs, GRACE if closed else None) and closed:
        raise closed[0].ended()


def stop(programs, patience):
    """Ends programs, whose pipes are closed by this; those that go on for so many seconds are told to end, then killed."""
    programs = [program for program in programs if not program._forked]
    _end([program._let_go() for program in programs], patience)
    for program in programs:
        program._finalizer.detach()
        _running.discard(program)


def _wait(programs, seconds=None, only=None):
    """Until a pipe is ready, whose content is moved; whether one was."""
    poll, watched = select.poll(), {}
    for program in programs:
        program.require_open()
        for pipe, events in program._watched():
            if only in (None, pipe):
                poll.register(pipe, events)
                watched[pipe.fileno()] = program, pipe
    ready = poll.poll(None if seconds is None else 1000 * seconds)
    for number, events in ready:
        program, pipe = watched[number]
        program.require_open()  # may have been closed meanwhile
        if pipe is program._process.stdin and not events & select.POLLOUT:
            program._stdin_closed = True
        else:
            program._move(pipe)
    return bool(ready)


def _end(processes, patience):
    try:
        for tell, seconds in ((None, patience), (subprocess.Popen.terminate, GRACE), (subprocess.Popen.kill, None)):
            until = None if seconds is None else time.monotonic() + seconds
            for process in processes if tell else ():
                tell(process)
            processes = [process for process in processes if not _has_ended(process, until)]
    except BaseException:
        for process in processes:
            process.kill()
        for process in processes:
            process.wait()
        raise


def _has_ended(process, until):
    try:
        process.wait(None if until is None else max(until - time.monotonic(), 0))
    except subprocess.TimeoutExpired:
        return False
    return True


def _close_pipes(process):
    for pipe in (process.stdin, process.stdout, process.stderr):
        pipe.close()


def _drop(process):
    """Ends a program that nobody can speak to any more."""
    _close_pipes(process)
    _end([process], 0)


def _leave_all_to_parent():
    for program in list(_running):
        program._leave_to_parent()


def _refuse(constant):
    raise ValueError(f"{constant} is no JSON")


def _printable(text):
    text = text if len(text) <= MAX_QUOTED else text[:MAX_QUOTED] + "…"
    return "".join(letter if letter.isprintable() else "\ufffd" for letter in text)


_running = weakref.WeakSet()
os.register_at_fork(after_in_child=_leave_all_to_parent)
