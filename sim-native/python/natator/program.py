"""The program natator-sim, and how it is started."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from natator.errors import InputError, ProgramError


def simulator_path(program=None):
    """Path of natator-sim: `program`, else $NATATOR_SIM, else that on the PATH, else that of the checkout which this package
    is run from. Raises ProgramError where there is none."""
    named = program or os.environ.get("NATATOR_SIM")
    if named:
        if not os.access(named, os.X_OK) or os.path.isdir(named):
            raise ProgramError(f"{named}: must be the program natator-sim (argument `program`, or $NATATOR_SIM)")
        return str(named)
    found = shutil.which("natator-sim")
    if found:
        return found
    built = Path(__file__).resolve().parents[3] / "build/release/bin/natator-sim"
    if os.access(built, os.X_OK):
        return str(built)
    raise ProgramError("no natator-sim: put the folder of the program, build/release/bin, on the PATH, or name it by NATATOR_SIM")


def start(program, arguments):
    """natator-sim with pipes as input and output. What it says on standard error is kept for `ended`."""
    command = [simulator_path(program), *map(str, arguments)]
    try:
        said = tempfile.TemporaryFile()
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=said)
        process.said = said
        return process
    except OSError as error:
        raise ProgramError(f"{command[0]}: cannot be started: {error.strerror}") from error


def ended(process):
    """The error that a program has ended with, though it was to go on."""
    code = process.wait()
    process.said.seek(0)
    said = process.said.read().decode(errors="replace").strip().removeprefix("natator-sim: ")
    if code == 2 and said:
        return InputError(said)
    return ProgramError(f"natator-sim has ended, exit code {code}" + (f": {said}" if said else ""))


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
