"""Which swim: that of a run folder of `natator evolve`, or of a scene."""

import json
from dataclasses import dataclass
from pathlib import Path

from natator.errors import InputError

EXACT = 1e-12


@dataclass(frozen=True)
class Source:
    """Who swims where. What is None is the scene's own."""

    scene: str
    gait: dict = None
    overrides: dict = None
    scheme: str = None
    duration: float = None
    run: Path = None
    best: dict = None  #: what the run folder has stored of the gait

    @property
    def name(self):
        """For files: the last part of the scene's name, or of its file's."""
        return Path(self.scene).name.removesuffix(".json")

    def difference(self, frame):
        """That the swim is not the one that the run folder has stored, in one line; None if it is, or that cannot be told by this
        Frame."""
        result = (self.best or {}).get("result", {})
        own_start = self.best and (self.best.get("runs", 1) == 1 or self.best.get("vacuum"))  # not from one of several starts
        if not own_start or result.get("frames") != frame.number or abs(frame.distance - self.best["distance"]) <= EXACT:
            return None
        return (f"{self.run}: stored {self.best['distance']:.4f}, today's program {frame.distance:.4f}: another program, or the scene "
                "was changed after the run was begun")


def source(named, gait=None, overrides=None, scheme=None):
    """The best swimmer of a run folder in its scene, or a scene with a body at rest. gait: a file that holds a gait, or one with the
    keys `gait` and `body`, as best.json and lines of evaluations.jsonl; overrides: a JSON Merge Patch or a file that holds one.
    Raises InputError."""
    given = {} if gait is None else _gait_in(gait)
    changes = _patch(overrides) if overrides is not None else None
    run = Path(named)
    if not run.is_dir():
        if named.endswith(".json") and not run.is_file():
            raise InputError(f"{named} is neither a run folder nor a scene: there is no such file")
        return Source(named, given.get("gait"), merged(given.get("body"), changes), scheme)
    if not (run / "config.json").is_file() and not (run / "islands.json").is_file():
        raise InputError(f"{run} is not a run folder: it has no config.json")
    config = {} if (run / "islands.json").is_file() else read_json(run / "config.json")
    if not config or "migration" in config:
        raise InputError(f"{run} was evolved on islands by an earlier version, which this one cannot read; "
                         "expected the folder of a run by itself")
    if not given and not (run / "best.json").is_file():
        raise InputError(f"{run} has no best gait yet: finish it by natator resume, or give a gait by --gait")
    swimmer = given or _gait_in(run / "best.json")
    same = not given and changes is None and scheme is None
    return Source(str(config.get("scene")), swimmer["gait"], merged(merged(config.get("overrides"), swimmer.get("body")), changes),
                  scheme or config.get("scheme"), config.get("duration"), run, swimmer if same else None)


def merged(one, other):
    """One JSON Merge Patch (RFC 7386) that does what both do in turn; None does nothing."""
    if one is None or other is None:
        return other if one is None else one
    both = dict(one)
    for key, value in other.items():
        both[key] = merged(both[key], value) if isinstance(both.get(key), dict) and isinstance(value, dict) else value
    return both


def read_json(file):
    """The object in a file. Raises InputError."""
    try:
        value = json.loads(Path(file).read_bytes())
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        raise InputError(f"{file} is no JSON: {error}") from error
    if not isinstance(value, dict):
        raise InputError(f"{file} holds {json.dumps(value)[:60]}; expected a JSON object")
    return value


def _gait_in(file):
    """A dict with the key `gait`."""
    value = read_json(file)
    if "gait" not in value:
        value = {"gait": value}
    for key in ("gait", *({"body"} & value.keys())):
        if not isinstance(value[key], dict):
            raise InputError(f"{file}: {key} is {json.dumps(value[key])[:60]}; expected a JSON object")
    value["gait"].pop("$schema", None)  # for editors
    return value


def _patch(text):
    if not text.lstrip().startswith("{"):
        return read_json(text)
    try:
        return json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(f"--overrides is no JSON: {error}") from error
