"""Evolution of a gait, with a verdict from runs that had no part in choosing it."""

import json
import math
import statistics
import warnings
from dataclasses import dataclass
from pathlib import Path

from natator.errors import InputError
from natator.gait import Gait, whole
from natator.plain import is_number
from natator.runs import effort, measures
from natator.script import package
from natator.simulator import Simulator, make_request
from natator.source import merged
from natator.stream import Stream
from natator.swimming import scene_of, swim

MIN_DISTANCE, SURE, MAX_CHANGE = 0.05, 2, 0.5  # body lengths, standard errors, share: as `natator evolve` has them
BEST = 5  # gaits that run again before one is chosen


def evolve(creature_or_scene, generations=10, seed=1, population=12, starts=2, duration=2.0, optimizer=None, workers=None, program=None, arguments=(),
           run=None, **request):
    """Evolves the gait that swims furthest along x, by CMA-ES (natator[cma]) or another optimizer; tqdm shows how far it is, if it is there.

    creature_or_scene: as of swim. generations, population, starts: how many; each gait of a generation runs from the same starts, each
    generation has others, and a gait's fitness is the mean distance, 0 if one run is unstable. The best five run again from new starts; chosen
    is the largest mean less a standard error. That one is told by max(4, 2 starts) fresh starts, and as many at half the time step.
    duration: s of a swim. optimizer: "cma-es", "map-elites" or "cma-me" (natator[ribs]), or anything with ask(), which gives lists of genes in [0, 1]
    (frequency 0.5 to 2, then amplitudes, then phases), and tell(genes, costs); if it has a true attribute `measures`, tell(genes, costs, measures): of
    each gait beats for a body length and cost of transport, or None. workers, program, arguments: as of Simulator. request: more fields of a request. The same seed,
    program and optimizer give the same gait for any number of workers. Returns an Evolved. Raises InputError and ProgramError.

    run: a run folder, which the program natator then makes and judges as that of `natator evolve --optimizer external`, or goes on with, also to more
    generations, if it is there. Genes are those of its encoding; arguments are more of its options. Returns an EvolvedRun (natator.external).
    """
    for name, value, least in (("generations", generations, 1), ("population", population, 2), ("starts", starts, 1), ("seed", seed, 1)):
        whole(name, value, least)
    if seed >= 2**32:
        raise InputError(f"seed = {seed}: must be below 2**32")
    scene = scene_of(creature_or_scene)
    make = _maker(optimizer, population, seed)
    if run is not None:
        from natator import external
        if others := sorted(request.keys() - {"overrides", "scheme"}):
            raise InputError(f"{others[0]} and run: expected one of them")
        return external.evolve(run, scene, generations, seed, population, starts, duration, make, workers, program, arguments, shown=_shown, **request)
    with Stream(scene, overrides=request.get("overrides"), scheme=request.get("scheme"), program=program) as stream:
        about, actuators = stream.scene, stream.actuators
    if not actuators:
        raise InputError(f'scene "{scene}": must have a creature with actuators')
    if about["scheme"] == "flex" and optimizer in ("map-elites", "cma-me"):
        raise InputError(f"optimizer = {optimizer}: must be another in scheme flex, which knows no work of muscles")
    optimizer = make(1 + 2 * actuators)
    half = merged(request.get("overrides"), {"solver": {"substeps": 2 * about["definition"]["solver"]["substeps"]}})
    first, judged, best, history = seed * 1_000_003, [], [], []

    with Simulator(workers, arguments, program) as simulator:
        def runs(gaits, count, **other):
            """Distances of each gait from the next so many starts, None of an unstable run; and of what scheme they were."""
            nonlocal first
            numbers, first = range(first, first + count), first + count
            requests = [make_request(scene, gait, **{**request, "duration": duration, "start": start, **other}) for gait in gaits for start in numbers]
            results = simulator.evaluate_all(requests)
            distances = [result["distance"] if result["status"] == "ok" else None for result in results]
            of = range(0, len(distances), count)
            return [distances[k:k + count] for k in of], results[0]["scheme"], [_measures(gait, results[k:k + count], about["bodyLength"])
                                                                                for gait, k in zip(gaits, of, strict=True)]

        for _ in _shown(range(generations), lambda: best and _fitness(best[0][1])):
            asked = candidates(optimizer)
            if not asked:
                raise InputError("optimizer: ask() gave no candidate: must be a list of at least one")
            gaits = [_gait(genes, actuators) for genes in asked]
            ways, scheme, kinds = runs(gaits, starts)
            judged += zip(gaits, ways)
            worth = [_fitness(way) for way in ways]
            tell(optimizer, asked, worth, kinds)
            best = sorted(judged, key=lambda one: _fitness(one[1]), reverse=True)[:BEST]
            judged = list(best)
            history.append((_fitness(best[0][1]), statistics.fmean(worth)))
        again = [(gait, way + more) for (gait, way), more in zip(best, runs([gait for gait, _ in best], max(2, starts))[0])]
        gait, way = max(again, key=lambda one: _fitness(one[1]) - _error(one[1]))
        fresh, = runs([gait], max(4, 2 * starts))[0]
        first -= len(fresh)  # the same starts
        at_half, = runs([gait], len(fresh), overrides=half)[0]
    return Evolved(scene, gait, _fitness(way), fresh, at_half, duration, about["bodyLength"], scheme, request, history, getattr(optimizer, "archive", None))


def candidates(optimizer):
    """Lists of numbers that it asks for. Raises InputError."""
    asked = optimizer.ask()
    try:
        return [list(map(float, genes)) for genes in asked]
    except (TypeError, ValueError):
        raise InputError(f"optimizer.ask() gave {str(asked)[:200]}: must be a list of lists of numbers") from None


def tell(optimizer, genes, fitness, kinds):
    """Tells an optimizer what gaits are worth, and the measures of those that get anywhere if it wants to know them."""
    optimizer.tell(genes, [-one for one in fitness], *[kinds] * bool(getattr(optimizer, "measures", False)))


@dataclass(frozen=True, repr=False)
class Evolved:
    """What came of an evolution. Its repr is the verdict, in one line. Distances are those of fresh starts, None of unstable runs."""

    scene: str
    gait: Gait
    selected: float      #: mean distance by which it was chosen; among so many, too good
    distances: list
    half_step: list      #: from the same starts, at half the time step
    duration: float      #: s
    body_length: float
    scheme: str
    request: dict        #: what else it was asked with
    history: list = ()   #: of each generation the best mean distance so far, and the mean over its gaits, length
    archive: object = None  #: the optimizer's, as of pyribs

    def __repr__(self):
        lengths = self.body_length * self.duration
        mean, error, half = _fitness(self.distances), _error(self.distances), _fitness(self.half_step)
        told = f"{mean / lengths:.3f} ± {error / lengths:.3f} body lengths/s, {half / lengths:.2f} at half the time step"
        if not mean - SURE * error >= MIN_DISTANCE * self.body_length:
            return f"does not swim, or the runs differ too much to tell: {told}"
        doubt = ("a run was unstable" if None in self.half_step else "the time step makes it" if abs(half - mean) > MAX_CHANGE * mean
                 else "scheme flex does not keep momentum" if self.scheme == "flex" else None)
        return f"may swim: {told}; {doubt}" if doubt else f"swims: {told}"

    def save(self, file):
        """Writes gait and verdict as JSON, which every --gait takes but natator-sim's: that is the key gait alone. Raises OSError."""
        told = {"scene": self.scene, "gait": self.gait.to_json(), "verdict": repr(self), "distances": self.distances, "halfStep": self.half_step,
                "duration": self.duration, "scheme": self.scheme, "selected": self.selected, "history": self.history, "request": self.request}
        Path(file).write_text(json.dumps(told, indent=2) + "\n", encoding="utf-8")

    def swim(self, **options):
        """One swim of it, to be seen: see natator.swim."""
        known = {key: self.request[key] for key in ("overrides", "scheme") if key in self.request}
        return swim(self.scene, **{"duration": self.duration, "gait": self.gait, **known, **options})


def _fitness(distances):
    return 0.0 if None in distances else statistics.fmean(distances)


def _error(distances):
    """Of the mean."""
    return 0.0 if None in distances else statistics.stdev(distances) / math.sqrt(len(distances))


def _gait(genes, actuators):
    """Raises InputError for what is none."""
    if len(genes) != 1 + 2 * actuators or not all(is_number(gene) and 0 <= gene <= 1 for gene in genes):
        raise InputError(f"optimizer.ask() gave {str(genes)[:200]}: must be {1 + 2 * actuators} numbers in [0, 1]")
    return Gait(0.5 + 1.5 * genes[0], genes[1:1 + actuators], genes[1 + actuators:])


def _measures(gait, results, body_length):
    """Of all runs of a gait together; None where one was unstable, or work is not measured."""
    if not all(result["status"] == "ok" and result.get("work") is not None for result in results):
        return None
    return measures(*sum(effort(gait.to_json(), result, body_length) for result in results))


def _maker(optimizer, population, seed):
    """What gives the optimizer for a number of genes."""
    if optimizer in (None, "cma-es"):
        return lambda genes: _cma_es(genes, population, seed)
    if optimizer in ("map-elites", "cma-me"):
        from natator.map_elites import MapElites
        return lambda genes: MapElites(optimizer, genes, population, seed)
    if not all(callable(getattr(optimizer, name, None)) for name in ("ask", "tell")):
        shown = f'"{optimizer}"' if isinstance(optimizer, str) else repr(optimizer)
        raise InputError(f"optimizer = {shown}: must be cma-es, map-elites, cma-me, or an object with ask and tell")
    return lambda _: optimizer


def _cma_es(genes, population, seed):
    with warnings.catch_warnings():  # that there is no matplotlib
        warnings.simplefilter("ignore")
        cma = package("cma", "cma", "evolve")
    return cma.CMAEvolutionStrategy([0.5] * genes, 0.25, {"bounds": [0, 1], "seed": seed, "popsize": population, "verbose": -9})


def _shown(generations, best):
    """With tqdm's bar, if it is installed, and the best fitness beside it."""
    try:
        from tqdm import tqdm
    except ImportError:
        yield from generations
        return
    with tqdm(generations, unit=" generations") as bar:
        for generation in bar:
            yield generation
            bar.set_postfix_str(f"best {best():.3f}")
