"""The program natator-sim, and how it is started."""

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path

from natator.errors import InputError, ProgramError


def simulator_path(program=None):
    """Path of natator-sim: `program`, else $NATATOR_SIM, else that on the PATH, else that of the checkout which this package
    is run from. Raises ProgramError where there is none."""
    named = program or os.environ.get("NATATOR_SIM")
    if named:
        if not os.access(named, os.X_OK) or os.path.isdir(named):
            raise _other_program(named)
        return str(named)
    found = shutil.which("natator-sim")
    if found:
        return found
    built = Path(__file__).resolve().parents[3] / "build/release/bin/natator-sim"
    if os.access(built, os.X_OK):
        return str(built)
    raise ProgramError("no natator-sim: put the folder of the program, build/release/bin, on the PATH, or name it by NATATOR_SIM")


def _other_program(path, wrong=""):
    return ProgramError(f"{path}{wrong}: must be the program natator-sim (argument `program`, or $NATATOR_SIM)")


def listed(name, values):
    """A list of an argument of this package that is to be one. Raises InputError for what is none, as a single text."""
    if isinstance(values, (str, bytes, Mapping)) or not isinstance(values, Iterable):
        raise InputError(f"{name} = {values!r}: must be a list of texts")
    return list(values)


def start(program, arguments):
    """natator-sim with pipes as input and output. What it says on standard error is kept for `ended`."""
    command = [simulator_path(program), *map(str, arguments)]
    said = tempfile.TemporaryFile()
    try:
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=said)
    except OSError as error:
        said.close()
        raise ProgramError(f"{command[0]}: cannot be started: {error.strerror}") from error
    except ValueError as error:
        said.close()
        raise InputError(f"argument of {command[0]}: {error}") from error
    process.said = said
    return process


def ended(process):
    """The error that a program has ended with, though it was to go on."""
    code = process.wait()
    process.said.seek(0)
    said = process.said.read().decode(errors="replace").strip().removeprefix("natator-sim: ")
    if code == 2 and said:
        return InputError(said)
    return ProgramError(f"natator-sim has ended, exit code {code}" + (f": {said}" if said else ""))


def no_simulator(process):
    """The error of a program that answers as none of ours does, which is ended."""
    process.kill()
    return _other_program(process.args[0], " answers as no simulator does")


def stop(process, patience=10):
    """Ends a program whose input is closed by this; kills one that goes on for so many seconds."""
    try:
        process.stdin.close()
    except BrokenPipeError:
        pass
    try:
        process.wait(timeout=patience)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    process.stdout.close()
    process.said.close()
