"""What a run folder of `natator evolve` holds: its course, its gaits, and the best gait of every kind."""

import csv
import json
import math
import statistics
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from natator.errors import InputError
from natator.source import read_json
from natator.stream import Stream

PER_OCTAVE, MAX_BEATS = 2, 128  # cells, and beats for a body length that get nowhere: as EliteMap.java has them
JUDGES = {"mean": statistics.fmean, "median": lambda runs: float(np.quantile(runs, 0.5)), "lower-quartile": lambda runs: float(np.quantile(runs, 0.25))}


@dataclass
class Tried:
    """A gait with all its runs up to now."""

    genes: tuple
    gait: dict
    generation: int     #: that it came in
    start: int          #: of its first run, or None
    worths: list = field(default_factory=list)  #: of each run, by the run's objectives, the scene's goals, or the distance
    ended: bool = False   #: whether any run came to a distance
    stable: bool = True   #: whether none broke a law of mechanics
    effort: np.ndarray = None  #: of the runs together: beats, body lengths and distance along x, work; None where not known

    @property
    def measured(self):
        """Whether it may be chosen."""
        return self.ended and self.stable

    @property
    def measures(self):
        """Beats for a body length, and cost of transport; None of what gets nowhere, or where they are not known."""
        return None if self.effort is None else measures(*self.effort)


def measures(beats, lengths, distance, work):
    """Beats for a body length, and cost of transport; None of what gets nowhere, or does no work."""
    return (beats / abs(lengths), work / abs(distance)) if beats < MAX_BEATS * abs(lengths) and distance and work > 0 else None


def kind(pair):
    """The cell of a pair of measures: whole numbers, each from 2^(n/2) on."""
    return tuple(math.floor(PER_OCTAVE * math.log(value) / math.log(2)) for value in pair)


class Run:
    """A run folder, also of a run that is under way. Raises InputError where a file is missing or damaged.

    Attributes: `folder`; `config`, a dict; `best`, best.json as a dict or None; `generations`, the rows of generations.csv as dicts of numbers;
    `seconds`, of each the time it took, None where that is not known; `judge`, what gives a gait's worth from that of its runs.
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        if not (self.folder / "config.json").is_file():
            raise InputError(f"{folder} is not a run folder: it has no config.json")
        self.config = read_json(self.folder / "config.json")
        self.best = read_json(self.folder / "best.json") if (self.folder / "best.json").is_file() else None
        self.generations = self._table("generations.csv")
        took = {row["generation"]: row["seconds"] for row in self._table("timings.csv")}
        self.seconds = [took.get(row["generation"]) for row in self.generations]
        self.judge = JUDGES[self.config.get("judge", "mean")]

    def _table(self, name):
        try:
            with open(self.folder / name, newline="", encoding="utf-8") as lines:
                return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]
        except FileNotFoundError:
            return []
        except (ValueError, TypeError, AttributeError) as error:
            raise InputError(f"{self.folder / name} is damaged: {error}") from error

    def evaluations(self):
        """Of each simulation the dict in evaluations.jsonl, in order. The line that a killed run was about to write is left out."""
        try:
            with open(self.folder / "evaluations.jsonl", encoding="utf-8") as lines:
                for number, line in enumerate(lines, 1):
                    if line.endswith("\n"):
                        try:
                            yield json.loads(line)
                        except ValueError as error:
                            raise InputError(f"{self.folder}/evaluations.jsonl, line {number} is no JSON: {error}") from error
        except FileNotFoundError:
            raise InputError(f"{self.folder} has no evaluations.jsonl: nothing is evaluated yet, or natator resume --compact dropped them") from None

    def course(self):
        """After each finished generation its number, and all gaits up to then as a dict by their genes; always the same dict."""
        tried, generation = {}, None
        last = self.generations[-1]["generation"] if self.generations else -1
        for one in self.evaluations():
            if one["generation"] > last:
                break
            if generation not in (None, one["generation"]):
                yield generation, tried
            generation = one["generation"]
            genes = tuple(one["genes"])
            gait = tried.get(genes) or tried.setdefault(genes, Tried(genes, one["gait"], generation, one.get("start")))
            self._add(gait, one["result"])
        if generation is not None:
            yield generation, tried

    def tried(self):
        """All gaits of finished generations, in the order in which they came."""
        gaits = {}
        for _, gaits in self.course():
            pass
        return list(gaits.values())

    def _add(self, gait, result):
        gait.worths.append(worth(result))
        gait.stable &= result["status"] != "unstable"
        if result["status"] == "ok":
            gait.ended = True
            effort = self._effort(gait.gait, result)
            if effort is not None:
                gait.effort = effort if gait.effort is None else gait.effort + effort

    def _effort(self, gait, result):
        if "effort" in result:
            return np.array([result["effort"][key] for key in ("beats", "lengths", "distance", "work")])
        if result.get("work") is None or not self.body_length:
            return None
        return effort(gait, result, self.body_length)

    @property
    def body_length(self):
        """Of the creature, head to tail at rest; None of bodies that are evolved, and without a creature."""
        if not hasattr(self, "_body_length"):
            known = (self.best or {}).get("bodyLength")
            if "evolve" in self.config:
                known = None
            elif known is None:
                with Stream(self.config["scene"], overrides=self.config.get("overrides"), scheme=self.config.get("scheme")) as stream:
                    known = stream.scene["bodyLength"]
            self._body_length = known
        return self._body_length

    def elites(self, tried):
        """The best of each kind that gets somewhere, by cells in order; of equals the first."""
        best = {}
        for gait in tried:
            if gait.measured and gait.measures:
                cell, value = kind(gait.measures), self.judge(gait.worths)
                if cell not in best or value > best[cell][1]:
                    best[cell] = gait, value
        return dict(sorted(best.items()))

    def genes(self):
        """Ranges of the genes of gaits by their names; None where bodies are evolved, which have others."""
        if "evolve" in self.config:
            return None
        unit, count, encoding = (0.0, 1.0), self.config["actuators"], self.config["encoding"]
        if encoding.startswith("dense"):
            own = dict.fromkeys([f"amplitude {i}" for i in range(1, count + 1)] + [f"phase {i}" for i in range(2, count + 1)], unit)
        else:
            last = {"waves": (0.25, 1.25)} if encoding.startswith("wave") else {"phase difference": unit}
            own = {"first amplitude": unit, "last amplitude": unit, **last}
        return {"frequency": (0.5, 2.0), **own, **({"offset": (-0.5, 0.5)} if encoding.endswith("-steered") else {})}


def effort(gait, result, body_length):
    """What a swim took: beats, body lengths and distance along x, work."""
    return np.array([gait["frequency"] * result["simulated"], result["distance"] / body_length, result["distance"], result["work"]])


def worth(result):
    """What a result is worth in its run, as SimulationResult.java has it."""
    if "worth" in result:
        return result["worth"]
    ok = result["status"] == "ok"
    if "goals" in result:
        return math.fsum(goal["weight"] * goal["score"] for goal in result["goals"]) if ok else 0.0
    return (result["distance"] if ok else 0.0) - max(result.get("vacuumDrift") or 0.0, 0.0)


def qd_score(elites):
    """Sum over all kinds of what their best is worth, where that is more than nothing."""
    return math.fsum(max(value, 0.0) for _, value in elites.values())
