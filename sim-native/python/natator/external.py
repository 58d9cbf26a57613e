"""Evolutions by the program natator, whose optimizer is here: the protocol of ga-java/docs/external.md."""

import contextlib
import json
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from natator.errors import InputError, ProgramError
from natator.evolution import candidates, tell
from natator.gait import Gait
from natator.plain import is_number
from natator.program import simulator_path
from natator.report import call, natator_path
from natator.source import read_json, source
from natator.swimming import swim

PROTOCOL = 1


def evolve(run, scene, generations, seed, population, starts, duration, make, workers=None, program=None, arguments=(), scheme=None, overrides=None,
           shown=lambda generations, _: iter(generations)):
    """Evolves into a run folder, new or that of an interrupted or shorter run, by the program natator. Returns an EvolvedRun.

    make: gives the optimizer for a number of genes; it asks and is told as one of natator.evolve, with genes in [0, 1], which are those of the run's
    encoding. shown: as evolution._shown. The rest is as of natator.evolve. Raises InputError and ProgramError.
    """
    run = Path(run)
    command = [natator_path(), "resume" if (run / "config.json").is_file() else "evolve", "--simulator-path", simulator_path(program)]
    if command[1] == "resume":
        _require_same(run, {"optimizer": "external", "population": population, "starts": starts, "seed": seed, "duration": duration, "scheme": scheme,
                            "overrides": overrides, **({} if scene.endswith(".json") else {"scene": scene})})
        command += [run, "--generations", generations - 1]
    else:
        command += ["--optimizer", "external", "--scene", scene, "--output-dir", run, "--generations", generations - 1, "--population", population, "--starts",
                    starts, "--seed", seed, "--duration", duration]
        command += [part for name, value in (("--scheme", scheme), ("--overrides", overrides and json.dumps(overrides))) if value for part in (name, value)]
    if workers is not None:
        command += ["--workers", workers]
    with tempfile.TemporaryFile() as errors, _started([*map(str, command), *map(str, arguments)], errors) as process:
        _converse(process, make, generations, shown)
        process.stdin.close()
        code = process.wait()
        if code:
            errors.seek(0)
            last = (errors.read().decode(errors="replace").strip().splitlines() or [f"natator has ended, exit code {code}"])[-1]
            raise (InputError if code == 2 else ProgramError)(last.removeprefix(f"natator {command[1]}: "))
    return EvolvedRun.read(run)


def _require_same(run, settings):
    """Raises InputError unless a run folder was begun with these; its generations may be others."""
    config = read_json(run / "config.json")
    for name, value in settings.items():
        if config.get(name) != value:
            raise InputError(f"{run} was begun with {name} {json.dumps(config.get(name))}, not {json.dumps(value)}: must be the same, or another folder")


@contextlib.contextmanager
def _started(command, errors):
    """The program, which ends with this, however that ends; what it was simulating then is simulated again when the run goes on."""
    try:
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=errors)
    except OSError as error:
        raise ProgramError(f"{command[0]}: cannot be started: {error.strerror}") from error
    try:
        yield process
    finally:
        process.terminate()
        process.wait()
        with contextlib.suppress(BrokenPipeError):
            process.stdin.close()
        process.stdout.close()


def _converse(process, make, generations, shown):
    optimizer, scale, asked, best = None, None, [], [0.0]
    bar = shown(range(generations), lambda: best[0])
    for line in process.stdout:
        try:
            message = json.loads(line)
            what = message["do"]
        except (ValueError, TypeError, KeyError):
            raise ProgramError(f"natator said {line[:100]!r}: must be a message to an optimizer") from None
        if what == "begin":
            if message.get("protocol") != PROTOCOL:
                raise ProgramError(f"natator speaks protocol {message.get('protocol')} to optimizers, this package {PROTOCOL}: must be of the same version")
            scale = _Scale(message["genes"])
            optimizer = make(len(message["genes"]))
        elif what == "ask":
            next(bar, None)
            asked = candidates(optimizer)
            _send(process, {"generation": message["generation"], "candidates": [scale.out(genes) for genes in asked]})
        elif what == "tell":
            told = message["candidates"]
            genes = [asked[k] if k < len(asked) and scale.out(asked[k]) == one["genes"] else scale.back(one["genes"]) for k, one in enumerate(told)]
            best[0] = max(best[0], *(one["fitness"] or 0.0 for one in told))
            tell(optimizer, genes, [one["fitness"] or 0.0 for one in told], [_measures(one) for one in told])
    for _ in bar:
        pass


def _send(process, message):
    with contextlib.suppress(BrokenPipeError):  # its end tells why
        process.stdin.write(json.dumps(message).encode() + b"\n")
        process.stdin.flush()


def _measures(told):
    return (told["measures"]["beatsPerLength"], told["measures"]["costOfTransport"]) if "measures" in told else None


class _Scale:
    """Between [0, 1] and the ranges of genes."""

    def __init__(self, genes):
        self._ends = [(gene["lower"], gene["upper"]) for gene in genes]

    def out(self, genes):
        if len(genes) != len(self._ends) or not all(is_number(gene) and 0 <= gene <= 1 for gene in genes):
            raise InputError(f"optimizer.ask() gave {str(genes)[:200]}: must be {len(self._ends)} numbers in [0, 1]")
        return [min(low + gene * (high - low), high) for gene, (low, high) in zip(genes, self._ends, strict=True)]

    def back(self, genes):
        return [min(max((gene - low) / (high - low), 0.0), 1.0) for gene, (low, high) in zip(genes, self._ends, strict=True)]


@dataclass(frozen=True, repr=False)
class EvolvedRun:
    """What came of an evolution in a run folder, which `natator show`, `check`, `view` and `python -m natator report` take. Its repr is the verdict."""

    run: Path
    gait: Gait
    verdict: str
    best: dict  #: best.json: what is to be reported of the gait is under "fresh"

    @staticmethod
    def read(run):
        """That of a finished run. Raises InputError and ProgramError."""
        best = read_json(Path(run) / "best.json")
        told = json.loads(call([natator_path(), "show", "--json", run]))
        return EvolvedRun(Path(run), Gait(**best["gait"]), " ".join(told["answer"]), best)

    def __repr__(self):
        return f"{self.run}: {self.verdict}"

    def swim(self, **options):
        """One swim of it, to be seen: see natator.swim."""
        own = source(str(self.run))
        known = {"overrides": own.overrides, "scheme": own.scheme, "duration": own.duration}
        return swim(own.scene, **{**{key: value for key, value in known.items() if value is not None}, "gait": self.gait, **options})
