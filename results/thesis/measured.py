"""What the study has found: rows of its files, means with their errors, winners, and whether they swim.

measurements.jsonl, with its first rows compressed beside it, holds evaluations, processor.jsonl some of them again on the processor, convergence.jsonl gaits at half the spacing, and
motions.jsonl how recorded bodies move. A row answers a request, and stays: it names the program that made it."""
import dataclasses
import functools
import gzip
import json
import math
import statistics
import zlib

from scipy import stats

import plan
import study
from plan import SECONDS, SUBSTEPS, WATERS

STILL = 0.01  # units/s: slower is no motion worth the name
FISH = ("anguilliform", "carangiform", "thunniform")


def canonical(value):
    """Numbers as numbers, keys in any order: what is the same is equal."""
    if isinstance(value, dict):
        return tuple(sorted((key, canonical(one)) for key, one in value.items() if key != "id"))
    return tuple(map(canonical, value)) if isinstance(value, list) else float(value) if type(value) is int else value


# What files must hold: parts that the page rests on.
ASKED = "program request.scene request.gait.frequency request.scheme request.overrides "
NEEDED = {"measurements.jsonl": ASKED + "backend result.status result.stopped", "processor.jsonl": ASKED + "backend result.status result.stopped result.hash",
          "convergence.jsonl": ASKED + "answer.levels", "motions.jsonl": ASKED + "bodyLength tailSwing fits fitsOfBody end.roll end.pitch largestYaw heights measuredPart",
          "finalists.json": "gaits", "config.json": "population generations",
          "json.gz": "request spine.times spine.centres centres attitude flow"}


def checked(text, where, needed):
    """JSON with all that is needed; ValueError that says where what is missing."""
    try:
        value = json.loads(text)
    except ValueError as error:
        raise ValueError(f"{where}: {error}; expected JSON") from error
    for name in needed.split() + (["result.distance", "result.simulated"] if '"status":"ok"' in str(text) else []):
        part = value
        for key in name.split("."):
            if not isinstance(part, dict) or part.get(key) is None:
                raise ValueError(f"{where}: has no {name}")
            part = part[key]
    return value


def unpacked(file):
    """What a compressed file holds; ValueError where it is damaged."""
    try:
        return gzip.decompress(file.read_bytes())
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        raise ValueError(f"{file}: {error}; expected a whole compressed file") from error


class Log:
    """Rows of a file of JSON lines and of its compressed one (.gz), by the request that each answers; a line that was cut off as it was written
    counts for nothing, and goes with the next row."""

    def __init__(self, file):
        self.file, self.rows, self.cut = file, {}, None
        packed = file.with_name(file.name + ".gz")
        if packed.exists():
            self.take(unpacked(packed), packed)
        if file.exists():
            text = file.read_bytes()
            whole = text[:text.rfind(b"\n") + 1]
            self.cut = len(whole) if whole != text else None
            self.take(whole, file)

    def take(self, text, file):
        for number, line in enumerate(text.splitlines(), 1):
            row = checked(line, f"{file}: line {number}", NEEDED.get(self.file.name, "request"))
            self.rows[canonical(row["request"])] = row

    def add(self, row):
        with open(self.file, "a", encoding="utf-8") as lines:
            if self.cut is not None:
                lines.truncate(self.cut)
                self.cut = None
            lines.write(json.dumps(row, separators=(",", ":"), ensure_ascii=False) + "\n")
        self.rows[canonical(row["request"])] = row

    def find(self, request):
        return self.rows.get(canonical(request))

    def missing(self, requests):
        """Those that no row answers, each once."""
        return list({canonical(one): one for one in requests if self.find(one) is None}.values())


@dataclasses.dataclass(frozen=True)
class Sample:
    """Mean and standard deviation of equal runs; NaN where there are too few."""
    count: int
    mean: float
    sd: float

    @classmethod
    def of(cls, values):
        values = list(values)
        return cls(len(values), statistics.fmean(values) if values else math.nan, statistics.stdev(values) if len(values) > 1 else math.nan)

    @property
    def error(self):
        """Standard error of the mean; 0 of a single value, which says nothing of its spread."""
        return self.sd / math.sqrt(self.count) if self.count > 1 else 0.0

    @property
    def interval(self):
        """Half the width of the mean's 95 % interval by Student's t; 0 of a single value."""
        return stats.t.ppf(0.975, self.count - 1) * self.error if self.count > 1 else 0.0


@dataclasses.dataclass(frozen=True)
class Speed:
    """Mean speed and what it is known to: its interval over starts, and the changes at half the time step and half the spacing (NaN: not measured)."""
    mean: float
    scatter: float
    half_step: float
    half_spacing: float

    @property
    def error(self):
        return max(self.scatter, *(abs(one) for one in (self.half_step, self.half_spacing, 0) if not math.isnan(one)))


def way(result):
    return result["distance"] if result["status"] == "ok" else 0.0


class Study:
    """A study's folder, read by its plan."""

    def __init__(self, folder, size):
        self.folder, self.plan, self.size = folder, plan.Plan(size), size
        self.duration = size.duration or SECONDS
        self.files, self.winners = {}, {}
        self.measurements, self.processor, self.convergence, self.motions = (
            Log(folder / f"{name}.jsonl") for name in ("measurements", "processor", "convergence", "motions"))

    # Evolutions and what they found.

    def finished(self):
        """Evolutions that have come to their end, and of which the finalists are known."""
        return [one for one in self.plan.evolutions if (one.folder(self.folder) / "finalists.json").exists()
                and self.generation(one) >= self.size.generations]

    def generation(self, evolution):
        """The last of an evolution."""
        return int((evolution.folder(self.folder) / "generations.csv").read_text(encoding="utf-8").splitlines()[-1].split(",")[0])

    def read(self, evolution, name):
        """A file of its run folder. What is finished does not change."""
        if (evolution, name) not in self.files:
            file = evolution.folder(self.folder) / name
            self.files[evolution, name] = checked(file.read_bytes(), file, NEEDED[name])
        return self.files[evolution, name]

    def finalists(self, evolution):
        return [plan.Subject(evolution.creature, evolution.water, one["gait"], "evolved", evolution.seed)
                for one in self.read(evolution, "finalists.json")["gaits"]]

    def winner(self, evolution):
        """The finalist that goes furthest by the mean of fresh runs less its standard error; None until all are measured."""
        if evolution not in self.winners:
            finalists = self.finalists(evolution)
            if not all(self.has(self.plan.finalist(one)) for one in finalists):
                return None
            self.winners[evolution] = max(finalists, key=self.sure)
        return self.winners[evolution]

    def sure(self, finalist):
        results = self.results(self.plan.finalist(finalist))
        ways = Sample.of(map(way, results))
        return -math.inf if any(one["status"] == "unstable" for one in results) else ways.mean - ways.error

    def evolved(self, water=None, creature=None):
        winners = [self.winner(one) for one in self.finished() if water in (None, one.water) and creature in (None, one.creature)]
        return [one for one in winners if one]

    def best(self, creature, water):
        """Of the seeds' winners the one that gets furthest by the lesser of its ways at both time steps."""
        known = [one for one in self.evolved(water, creature) if self.has(self.plan.of(one, "half-step"))]
        return max(known, key=lambda one: min(self.over_time(one, "water").mean, self.over_time(one, "half-step").mean), default=None)

    def bests(self, water):
        return [one for creature in self.size.creatures if (one := self.best(creature, water))]

    def portrayed(self):
        """The fastest that evolved in open water, else in flex, or None."""
        return next((max(best, key=lambda one: self.means(one, "water").mean) for water in reversed(WATERS) if (best := self.bests(water))), None)

    def subjects(self, water):
        return self.plan.published(water) + self.evolved(water)

    def studied(self, water):
        """Gaits with which parameters are studied."""
        published = [plan.subject_of(one, water) for one in plan.GAITS if one["name"] == plan.STUDIED and one["creature"] in self.size.creatures]
        return published + [one for creature in self.plan.potent() if (one := self.best(creature, water))]

    def experiments(self):
        """All that is known by now to be measured; what is found adds to it."""
        every = self.plan.independent() + [self.plan.finalist(one) for run in self.finished() for one in self.finalists(run)]
        every += [experiment for subject in self.evolved() for experiment in self.plan.all_of(subject)]
        every += [one for water in WATERS if (gait := self.two_clusters_that_move(water)) for one in self.plan.controls_of_two_clusters(gait, water).values()]
        every += [self.plan.weaker(subject) for subject in self.studied("flex")]
        return every + [one for water in WATERS for subject in self.studied(water) for one in self.plan.studies(subject)]

    def two_clusters_that_move(self, water):
        """The gait by which the body of two clusters goes furthest, if that is further than at rest by more than chance; else None."""
        gaits = self.plan.gaits_of_two_clusters()
        rest = self.forward(self.plan.two_clusters(gaits[0], water, "resting"))
        known = [(one, gait) for gait in gaits if (one := self.forward(self.plan.two_clusters(gait, water, "water"))).count]
        if not rest.count or not known:
            return None
        best, gait = max(known, key=lambda pair: pair[0].mean)
        net = best.mean - rest.mean
        return gait if net > math.hypot(best.interval, rest.interval) and net > STILL else None

    def swims(self):
        """Every gait in its water."""
        return [(subject, self.plan.of(subject, "water")) for water in WATERS for subject in self.subjects(water)]

    def recorded(self):
        """What is recorded: every gait in its water, and published ones in the tank of inverse masses."""
        return [one for _, one in self.swims()] + [self.plan.of(one, "inverse-mass") for one in self.plan.published("flex")]

    def drawn(self):
        """What is drawn, as requests of runs that nothing ends early, by the name of its recording."""
        drawn = {f"thesis-{one['name']}": plan.subject_of(one, "flex") for one in plan.GAITS if one["creature"] in self.size.creatures}
        drawn |= {f"creature-{one.creature}-{water}": one for water in WATERS for one in self.bests(water)}
        return {name: plan.merged(self.plan.of(one, "water").request, plan.stopping(False)) for name, one in drawn.items()}

    def recording_file(self, name):
        return self.folder / "recordings" / f"{name}.json.gz"

    def recording(self, name, request):
        """That of just this request, or None: with more seeds another run may be the best."""
        file = self.recording_file(name)
        if not file.exists():
            return None
        found = checked(unpacked(file), file, NEEDED["json.gz"])
        return found if canonical(found["request"]) == canonical(request) else None

    # Runs and means.

    def results(self, experiment, log=None):
        found = ((log or self.measurements).find(one) for one in experiment.runs())
        return [row["result"] for row in found if row]

    def has(self, experiment):
        return len(self.results(experiment)) == experiment.starts

    def sample(self, experiment, value, log=None):
        """Of the runs that stayed stable."""
        return Sample.of(value(one) for one in self.results(experiment, log) if one["status"] == "ok")

    def over_time(self, subject, condition):
        """Ways along x by the whole time, whether a run lasted so long or not."""
        return self.sample(self.plan.of(subject, condition), lambda one: one["distance"] / self.duration)

    def means(self, subject, condition, log=None):
        """Speeds: in the thesis' tank over the whole time, in open water, which stands for water without walls, until a run ends at one."""
        water = plan.other(subject.water) if condition == "other-water" else subject.water
        return self.sample(self.plan.of(subject, condition),
                           lambda one: one["distance"] / (self.duration if water == "flex" else one["simulated"]), log)

    def forward(self, experiment):
        """Speeds along the body's own heading while the runs lasted."""
        return self.sample(experiment, lambda one: one.get("course", {"forward": one["distance"]})["forward"] / one["simulated"])

    def lasted(self, subject):
        return self.sample(self.plan.of(subject, "water"), lambda one: one["simulated"])

    def unstable(self, experiment):
        return sum(one["status"] == "unstable" for one in self.results(experiment))

    def speed(self, subject):
        """None while it is not measured."""
        water, half = self.means(subject, "water"), self.means(subject, "half-step")
        return Speed(water.mean, water.interval, half.mean - water.mean, self.half_spacing(subject)) if water.count else None

    def spacings(self, subject):
        """Speed as it is and at half the spacing, from the same starts; NaN if it was not measured or became unstable."""
        row = self.convergence.find(self.plan.of(subject, "water").request)
        levels = {one["level"]: one.get("speed", {}).get("mean", math.nan) for one in row["answer"]["levels"]} if row else {}
        return levels.get("base", math.nan), levels.get("spacing/2", math.nan)

    def half_spacing(self, subject):
        """The change of its speed at half the spacing, or NaN."""
        base, half = self.spacings(subject)
        return half - base

    def number(self, subject, name):
        """Mean of a dimensionless number of its swims, or None."""
        known = [one["swimming"][name] for one in self.results(self.plan.of(subject, "water")) if one.get("swimming", {}).get(name) is not None]
        return statistics.fmean(known) if known else None

    def ends_at_wall(self, subject):
        return mostly_stopped(self.results(self.plan.of(subject, "water"))) == "touched-plane"

    @functools.cache
    def length(self, creature):
        """Head to tail at rest, as recorded; NaN if it was not."""
        return next((row["bodyLength"] for water in WATERS for one in self.plan.published(water) if one.creature == creature
                     for row in self.motions_of(self.plan.of(one, "water"))), math.nan)

    def motions_of(self, experiment):
        found = map(self.motions.find, experiment.recordings(min(self.size.recorded, self.size.runs)))
        return [row for row in found if row]

    def moves(self, subject):
        return self.motions_of(self.plan.of(subject, "water"))

    # Whether it swims.

    def verdict(self, subject):
        """(✔ ✘ or –, why); None while a control is missing. The processor is another backend only of what was measured on a GPU."""
        swim = self.plan.of(subject, "water")
        names = ("water", "resting", "vacuum", "half-step", "mirrored") + (("no-clamp",) if subject.water == "flex" else ())
        ways = {name: self.results(self.plan.of(subject, name)) for name in names}
        if not all(ways.values()):
            return None
        on_gpu = any(row["backend"] != "cpu" for row in map(self.measurements.find, swim.runs()) if row)
        ways["cpu"] = self.results(swim, self.processor) if on_gpu else []
        base, half = self.spacings(subject)
        return judged({name: one for name, one in ways.items() if one}, self.length(subject.creature), self.duration, self.under_water(subject), half / base)

    def swims_by_every_control(self, subject):
        return (self.verdict(subject) or "–")[0] == "✔"

    def may_swim(self, subject):
        return (self.verdict(subject) or "✘")[0] != "✘"

    def under_water(self, subject):
        """Share of the body's particles below the water's level halfway, or None."""
        known = [one["underWater"] for one in self.moves(subject) if one.get("underWater") is not None]
        return statistics.fmean(known) if known else None

    def on_processor(self, subject):
        """Mean speed there, or None where that is no other backend."""
        return self.means(subject, "water", self.processor)


def mostly_stopped(results):
    ends = [one["stopped"] or "failed" for one in results]
    return max(sorted(set(ends)), key=ends.count)


def fixed(value, digits=2):
    return study.fixed(value, digits) if math.isfinite(value) else "–"


def with_error(value, error, digits=2):
    return study.with_error(value, error, digits) if math.isfinite(value) else "–"


def error_text(error):
    """An error bar alone."""
    return with_error(0, error).split(" ", 1)[1]


def percent(share):
    return f"{fixed(100 * share, 0)} %"


def judged(runs, length, duration, under_water, finer):
    """One verdict from all controls, as natator check has it, and half the spacing: it swims if it gets further than a dead body does, by more than
    chance, in the water, and not by the vacuum's drift, the clamp, the time step, the spacing, one side of its body, or one backend.

    runs: results by condition; length: of the body in scene units; under_water: share of the body, or None; finer: share of its speed that is left
    at half the spacing, or NaN."""
    ways = {name: Sample.of(map(way, results)) for name, results in runs.items()}
    net = ways["water"].mean - ways["resting"].mean
    drift, known = abs(ways["vacuum"].mean) / net, {name: 2 * one.error / net for name, one in ways.items()}
    left = {name: (one.mean - ways["resting"].mean) / net for name, one in ways.items()}
    sd = ways["water"].sd if ways["water"].count > 1 else 0.0
    if net / length < 0.05:
        return "✘", (f"does not swim: moves {with_error(net / length, sd / length, 3)} body lengths further than a resting body in "
                     f"{fixed(duration)} s, less than 0.05")
    if drift - known["vacuum"] >= 0.5:
        return "✘", f"does not swim: moves {fixed(drift, 1)} times as far in vacuum" + (", the other way" if ways["vacuum"].mean < 0 else "")
    if "no-clamp" in ways and left["no-clamp"] + known["no-clamp"] < 0.5:
        return "✘", f"does not swim: the acceleration clamp moves it; without, {percent(left['no-clamp'])} of its way is left"
    at_wall = mostly_stopped(runs["water"]) == "touched-plane"
    speed = f"{with_error(net / duration / length, sd / duration / length)} body lengths/s more than a resting body" \
        + (", until it touches a wall" if at_wall else "")
    doubts = list(doubted(runs, ways, net, length, drift, known, left, under_water, at_wall, finer))
    if doubts:
        return "–", f"may swim: {speed}; but " + "; ".join(doubts)
    where = ["not in vacuum"] + ([f"without the acceleration clamp ({percent(left['no-clamp'])})"] if "no-clamp" in left else []) \
        + [f"at half the time step ({percent(left['half-step'])} of its way)", f"at half the spacing ({percent(finer)})", f"mirrored ({percent(left['mirrored'])})"] \
        + ([f"on cpu ({percent(left['cpu'])})"] if "cpu" in left else [])
    return "✔", f"swims: {speed}, " + ", ".join(where) + ("" if under_water is None else f"; {percent(under_water)} under water")


def doubted(runs, ways, net, length, drift, known, left, under_water, at_wall, finer):
    error = math.hypot(ways["water"].error, ways["resting"].error)
    if (net - 2 * error) / length < 0.05:
        yield "its runs differ too much to tell"
    if at_wall and ways["water"].mean / length < 0.5:
        yield "the wall is nearer than 0.5 body lengths"
    if drift + known["vacuum"] >= 0.5:
        yield f"it moves {with_error(drift, known['vacuum'], 1)} times as far in vacuum"
    if "no-clamp" in left and left["no-clamp"] - known["no-clamp"] < 0.5:
        yield f"without the acceleration clamp {percent(left['no-clamp'])} ± {percent(known['no-clamp'])} of its way is left"
    if under_water is not None and under_water < 0.5:
        yield f"it skims: {percent(under_water)} of its body are under water"
    if abs(left["half-step"] - 1) > 0.5:
        yield f"at half the time step it has {percent(left['half-step'])} of its way"
    if not abs(finer - 1) <= 0.5:
        yield "it has no stable run at half the spacing" if math.isnan(finer) else f"at half the spacing it has {percent(finer)} of its speed"
    words = {"water": "", "resting": " at rest", "vacuum": " in vacuum", "no-clamp": " without the acceleration clamp",
             "half-step": " at half the time step", "mirrored": " mirrored", "cpu": " on cpu"}
    for name in words.keys() & runs.keys():
        broken = sum(one["status"] == "unstable" for one in runs[name])
        if broken:
            yield f"{broken} of {len(runs[name])} runs {'was' if broken == 1 else 'were'} unstable{words[name]}"
    for name in ("mirrored", "cpu"):
        if name in left and left[name] < 0.5:
            yield f"{words[name].strip()} {percent(left[name])} of its way is left"


# Like which fish. Fits are those of motions.jsonl: "fits" as in the thesis, "fitsOfBody" with the body's roll taken out.

def error(rows, fish, fits):
    return Sample.of(row[fits][fish]["error"] for row in rows)


def relative(rows, fish, fits):
    """e as a share of that of no motion, whose e is 1/3 in old files."""
    return statistics.fmean(row[fits][fish]["error"] / row[fits][fish].get("none", 1 / 3) for row in rows)


def scale(rows, fish, fits):
    """α, by which the simulated spine is scaled to fit best."""
    return statistics.fmean(row[fits][fish]["alpha"] for row in rows)


def nearest(rows, fits, of=range(3)):
    return min(of, key=lambda fish: error(rows, fish, fits).mean, default=None)


def like(rows, fits):
    """Of the fish that the motion is like at all the nearest, or None: nearer than no motion by a fifth, and not only once it is made tiny."""
    return nearest(rows, fits, [fish for fish in range(3) if relative(rows, fish, fits) <= 0.8 and scale(rows, fish, fits) >= 0.1])
