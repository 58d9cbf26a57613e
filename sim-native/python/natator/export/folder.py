"""The folder of an export: whole, or not there."""

import fcntl
import json
import os
import shutil
from pathlib import Path

from natator.errors import InputError

METADATA = "metadata.json"
FILES = "files"  #: its entry with the names of all files of the export
LOCK = "export.lock"


def files_in(folder):
    """Names of all files in a folder and in its folders, in order, with slashes between; none of a lock."""
    names = (path.relative_to(folder).as_posix() for path in Path(folder).rglob("*") if path.is_symlink() or not path.is_dir())
    return sorted(name for name in names if name != LOCK)


class ExportFolder:
    """A context that holds an export under the name NAME.partial, which `commit` changes to NAME; what was not committed goes.
    What a killed program left goes with the next export to the same place.

    A folder that is there already stays the one that it is: an empty one is filled, `metadata.json` last, and so is one that holds
    an export and nothing else, if that may be replaced. Raises InputError for any other.
    """

    def __init__(self, folder, replace=False):
        self._name, self._replace = folder, replace
        self._target = Path(os.path.realpath(folder))
        self.path = self._target.with_name(self._target.name + ".partial") if self._target.name else None

    def __enter__(self):
        if self.path is None:
            raise InputError(f"output folder is {self._name}: must be a folder of its own")
        if os.path.islink(self._name) and not self._target.exists():
            raise InputError(f"output folder {self._name} is a link that leads nowhere")
        self._require_free()
        if self.path.exists() and any(self.path.iterdir()) and not (self.path / LOCK).exists():
            raise InputError(f"{self.path} is in the way; remove it")
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            self._lock = open(self.path / LOCK, "w")
        except OSError as error:
            raise InputError(f"output folder {self._name} cannot be made: {error.filename}: {error.strerror}") from error
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            self._lock.close()
            raise InputError(f"another export to {self._name} is being written") from error
        _clear(self.path)
        return self

    def _require_free(self):
        """Raises InputError if something else is there than an export that may be replaced."""
        if self._target.exists() and not self._target.is_dir():
            raise InputError(f"output folder {self._name} cannot be made: there is a file of that name")
        if not self._target.exists() or not any(self._target.iterdir()):
            return
        try:
            known = set(json.loads((self._target / METADATA).read_bytes())[FILES])
        except (OSError, ValueError, KeyError, TypeError):
            raise InputError(f"output folder {self._name} is not empty and holds no export: it has no {METADATA} that lists one; "
                             "choose another by --output-dir") from None
        for name in files_in(self._target):
            if name not in known:
                raise InputError(f"output folder {self._name} holds {name}, which is no part of the export in it; move it away, or "
                                 "choose another folder by --output-dir")
        if not self._replace:
            raise InputError(f"output folder {self._name} is not empty; choose another by --output-dir, or replace the export in it "
                             "by --force")

    def commit(self):
        """Gives the folder its name, or fills that which is there: who put something else there meanwhile keeps it."""
        self._require_free()
        if self._target.exists():
            (self._target / METADATA).unlink(missing_ok=True)
            _clear(self._target)
            for name in sorted(os.listdir(self.path), key=METADATA.__eq__):
                if name != LOCK:
                    shutil.move(self.path / name, self._target / name)
        else:
            self.path.rename(self._target)
            (self._target / LOCK).unlink()

    def __exit__(self, *_):
        with self._lock:
            if self.path.exists():
                _clear(self.path)
                (self.path / LOCK).unlink(missing_ok=True)  # last: what a kill leaves is known by it
                self.path.rmdir()


def _clear(folder):
    """Removes everything in a folder except its lock."""
    for path in folder.iterdir():
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        elif path.name != LOCK:
            path.unlink()
