"""Evolves and measures what is missing in a study's folder: by `natator evolve` and `natator resume`, by the Python client, and by `natator-sim
converge` and `run`. What is done stays, row by row, so that a study that was killed goes on where it was."""
import collections
import concurrent.futures
import fcntl
import gzip
import hashlib
import json
import os
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile

import natator
import numpy as np
from natator.program import simulator_path

import measured
from natator import motion
import plan

FINALISTS = 8
KEPT = ("status", "distance", "stopped", "simulated", "frames", "scheme", "precision", "hash", "unstable", "error", "swimming", "work", "course", "goals")
UNSTABLE = 3  # exit code of a run that has an answer nevertheless


class Failure(Exception):
    """What went wrong, in one line."""


def call(command, accepted=(0,), **environment):
    """Standard output of a program; Failure with its last line where it fails."""
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, encoding="utf-8", env={**os.environ, **environment})
    if done.returncode not in accepted:
        said = (done.stderr.strip() or done.stdout.strip() or "it said nothing").splitlines()[-1]
        raise Failure(f"{' '.join(map(str, command[:4]))} … ended with exit code {done.returncode}: {said}")
    return done.stdout


def write(file, value, opened=open):
    """As JSON; the file appears whole."""
    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_name(file.name + ".part")
    with opened(part, "wt", encoding="utf-8") as text:
        json.dump(value, text, separators=(",", ":"))
    part.replace(file)


def ranked(rows):
    """Finalists of evaluations, the best first: gaits that swam with both starts of a newborn, and were unstable in none."""
    runs = collections.defaultdict(list)
    for row in rows:
        runs[tuple(row["genes"])].append(row)
    found = [{"gait": one[0]["gait"], "score": statistics.fmean(measured.way(row["result"]) for row in one), "runs": len(one)} for one in runs.values()
             if len(one) > 1 and any(row["result"]["status"] == "ok" for row in one) and all(row["result"]["status"] != "unstable" for row in one)]
    return sorted(found, key=lambda one: -one["score"])


def joined(before, since):
    """Finalists of evaluations that are gone, with those since: their own runs count too, and unstable ones go."""
    own = collections.defaultdict(list)
    for row in since:
        own[measured.canonical(row["gait"])].append(row["result"])
    known = []
    for one in before:
        runs = own[measured.canonical(one["gait"])]
        if all(run["status"] != "unstable" for run in runs):
            count = one["runs"] + len(runs)
            known.append({"gait": one["gait"], "score": (one["score"] * one["runs"] + sum(map(measured.way, runs))) / count, "runs": count})
    gaits = {measured.canonical(one["gait"]) for one in before}
    others = [one for one in ranked(since) if measured.canonical(one["gait"]) not in gaits]
    return sorted(known + others, key=lambda one: -one["score"])


class Work:
    def __init__(self, study, backend, workers):
        self.study, self.backend = study, backend
        self.workers = workers or len(os.sched_getaffinity(0))
        self.simulator = simulator_path()
        self.program = hashlib.sha256(pathlib.Path(self.simulator).read_bytes()).hexdigest()
        self.natator = ["java", "-jar", plan.HERE.parent.parent / "ga-java/target/natator.jar"]

    def all(self):
        """In the order in which one thing makes the next known; by one program at a time in a folder."""
        self.study.folder.mkdir(parents=True, exist_ok=True)
        with open(self.study.measurements.file, "a", encoding="utf-8") as held:
            try:
                fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError as error:
                raise Failure(f"{held.name} is in use by another run") from error
            for work in (self.evolve, self.measure, self.on_processor, self.record, self.finer, self.portray):
                work()

    def say(self, count, what):
        print(f"{count} {what}", file=sys.stderr, flush=True)

    def unfinished(self):
        finished = self.study.finished()
        return [one for one in self.study.plan.evolutions if one not in finished]

    def missing(self):
        """What is, of all that is known by now, in words."""
        study = self.study
        return (f"{len(self.unfinished())} evolutions to finish; then, of what is evolved so far, {len(self.to_measure())} evaluations, "
                f"{len(study.convergence.missing(self.to_refine()))} gaits at half the spacing, {len(study.processor.missing(self.again()))} runs on "
                f"the processor, {len(study.motions.missing(self.to_record()))} motions and {len(self.undrawn())} recordings")

    # Evolutions.

    def evolve(self):
        """All seeds of a creature in a water at once."""
        left = self.unfinished()
        if left:
            self.say(len(left), "evolutions to finish")
        options = ["--simulator-path", self.simulator, "--workers", self.workers]
        for one in {(one.creature, one.water): one for one in left}.values():
            call([*self.natator, "evolve", *one.arguments(), "--backend", self.backend, "--output-dir", one.folder(self.study.folder).parent, *options])
        for one in left:
            self.keep_finalists(one.folder(self.study.folder))
            call([*self.natator, "resume", one.folder(self.study.folder), "--compact", *options])
        self.study.files.clear()

    def keep_finalists(self, folder):
        """The best gaits, since the evaluations that they are taken from are too large to be kept."""
        file, evaluations = folder / "finalists.json", folder / "evaluations.jsonl"
        generation = json.loads((folder / "checkpoint.json").read_text(encoding="utf-8"))["generation"]
        before = json.loads(file.read_text(encoding="utf-8")) if file.exists() else None
        if before and (before.get("generation") == generation or not evaluations.exists()):
            return
        rows = [json.loads(line) for line in evaluations.read_text(encoding="utf-8").splitlines()]
        if not before or rows[0]["result"]["id"] == 0:
            gaits = ranked(rows)
        else:
            gaits = joined(before["gaits"], [row for row in rows if row["generation"] > before.get("generation", -1)])
        if not gaits:
            raise Failure(f"{folder} has no gait that stayed stable; expected one among its evaluations")
        write(file, {"gaits": gaits[:FINALISTS], "generation": generation})

    # Measurements.

    def to_measure(self):
        return self.study.measurements.missing([run for one in self.study.experiments() for run in one.runs()])

    def measure(self):
        """First what is known, then what that has made known."""
        while asked := self.to_measure():
            self.evaluate(asked, self.study.measurements, self.backend)

    def evaluate(self, asked, log, backend):
        self.say(len(asked), f"evaluations on {backend}")
        arguments, workers = ([], self.workers) if backend == "cpu" else (["--backend", backend], 1)
        size = 8 * workers if backend == "cpu" else 256  # evaluated together, then kept
        with natator.Simulator(workers, arguments, self.simulator) as simulator:
            for first in range(0, len(asked), size):
                some = asked[first:first + size]
                for request, result in zip(some, simulator.evaluate_all(some)):
                    log.add({"program": self.program, "backend": backend, "request": {**request, "id": 0},
                             "result": {"id": 0, **{key: result[key] for key in KEPT if key in result}}})

    def again(self):
        """What is measured on the processor too: bits that can be checked anywhere, and a second backend for the winners."""
        return [run for _, one in self.study.swims() for run in one.runs()[:2]]

    def on_processor(self):
        asked = self.study.processor.missing(self.again())
        if asked:
            self.evaluate(asked, self.study.processor, "cpu")

    def to_refine(self):
        return [self.study.plan.of(one, "water").request for water in self.study.size.finer for one in self.study.subjects(water)
                if one.seed or self.study.may_swim(one)]

    def finer(self):
        """What evolved, and what else may swim, at half the spacing of all particles, from eight starts."""
        asked = self.study.convergence.missing(self.to_refine())
        if asked:
            self.say(len(asked), "gaits at half the spacing")
        for request in asked:
            answer = call([self.simulator, "converge", json.dumps(request), "--starts", 8, "--levels", "spacing/2", "--backend", self.backend,
                           *(["--threads", self.workers] if self.backend == "cpu" else [])], (0, UNSTABLE))
            self.study.convergence.add({"program": self.program, "backend": self.backend, "request": request, "answer": json.loads(answer)})

    # Recordings.

    def to_record(self):
        return [run for one in self.study.recorded() for run in one.recordings(min(self.study.size.recorded, self.study.size.runs))]

    def undrawn(self):
        return {name: request for name, request in self.study.drawn().items() if not self.study.recording(name, request)}

    def record(self):
        def measure(request):
            times, particles, fluid, body, _ = self.path(request)
            under = motion.share_below(fluid[:, :3], body[:, :3])
            return {"program": self.program, "request": request, **motion.moved(times, particles, request["gait"]["frequency"], under)}

        def draw(drawn):
            name, request = drawn
            times, particles, fluid, body, time = self.path(request)
            angles = [dict(zip(("roll", "yaw", "pitch"), one)) for one in motion.attitude(particles).tolist()]
            flow = [motion.flow(time, fluid[:, :3], fluid[:, 3:], body[:, :3], view) for view in ("ABOVE", "SIDE")] if len(fluid) else []
            write(self.study.recording_file(name),
                  {"program": self.program, "request": request, "spine": {"times": times.tolist(), "centres": motion.slices(particles).round(6).tolist()},
                   "centres": particles.mean(axis=1).round(6).tolist(), "attitude": angles, "flow": flow}, gzip.open)

        self.in_threads(measure, self.study.motions.missing(self.to_record()), "motions to record", self.study.motions.add)
        self.in_threads(draw, list(self.undrawn().items()), "recordings to draw")

    def path(self, request):
        """A run on the processor: times, particles of the body [frame, particle, axis], and place and velocity of water and body halfway."""
        with tempfile.TemporaryDirectory() as folder:
            path, particles = pathlib.Path(folder) / "path.csv", pathlib.Path(folder) / "particles.csv"
            shift = request.get("perturbation")
            call([self.simulator, "run", request["scene"], "--gait", json.dumps(request["gait"]), "--scheme", request["scheme"], "--overrides",
                  json.dumps(request["overrides"]), "--duration", self.study.duration, "--trajectory", path, "--particles", "--snapshot", particles,
                  "--at", self.study.duration / 2, *(["--perturbation", shift["amplitude"], "--perturbation-seed", shift["seed"]] if shift else [])],
                 (0, UNSTABLE))
            frames = np.loadtxt(path, delimiter=",", skiprows=1)
            count = int((frames[:, 0] == frames[0, 0]).sum())
            lines = [line.split(",") for line in particles.read_text(encoding="utf-8").splitlines()]
        columns = [lines[0].index(name) for name in ("x", "y", "z", "vx", "vy", "vz")]
        fluid, body = (np.array([[float(line[i]) for i in columns] for line in lines[1:] if (line[1] == "fluid") == wet]).reshape(-1, 6)
                       for wet in (True, False))
        return frames[::count, 1], frames[:, 3:].reshape(-1, count, 3), fluid, body, float(lines[1][0])

    def portray(self):
        """The fastest swimmer, halfway."""
        one, file = self.study.portrayed(), self.study.folder / "figures" / "swimmer.png"
        if one and not file.exists():
            write(self.study.folder / "gait.json", one.gait)
            file.parent.mkdir(exist_ok=True)
            call([sys.executable, "-m", "natator", "picture", plan.scene(one.creature, one.water), "--gait", self.study.folder / "gait.json", "--scheme",
                  plan.SCHEME[one.water], "--at", self.study.duration / 2, "--from", "three-quarter", "--output", file],
                 NATATOR_SIM=str(self.simulator), PYTHONPATH=str(pathlib.Path(__file__).resolve().parents[2] / "sim-native" / "python"))
            (self.study.folder / "gait.json").unlink()

    def in_threads(self, work, asked, what, done=lambda _: None):
        """Some at a time, each then handed to `done` here; the first failure ends it, when those under way are done."""
        if asked:
            self.say(len(asked), what)
        with concurrent.futures.ThreadPoolExecutor(self.workers) as threads:
            under_way = [threads.submit(work, one) for one in asked]
            try:
                for one in concurrent.futures.as_completed(under_way):
                    done(one.result())
            except BaseException:
                threads.shutdown(cancel_futures=True)
                raise

    # Whether the present program still makes what is stored.

    def repeat(self, count, seed, water):
        rows = [row for row in self.study.processor.rows.values() if water is None or row["request"]["scheme"] == plan.SCHEME[water]]
        drawn = random.Random(seed).sample(rows, min(count, len(rows)))
        if not drawn:
            raise Failure(f"{self.study.processor.file} holds no runs to do again; expected those of --run")
        with natator.Simulator(self.workers, program=self.simulator) as simulator:
            now = [one["hash"] for one in simulator.evaluate_all([row["request"] for row in drawn])]
        for row, found in zip(drawn, now):
            if row["result"]["hash"] != found:
                print(f"differs: {json.dumps(row['request'])} ended as {row['result']['hash']}, now as {found}")
        same = sum(row["result"]["hash"] == found for row, found in zip(drawn, now))
        print(f"{same} of {len(drawn)} runs end with the same bits")
        return 0 if same == len(drawn) else 1
