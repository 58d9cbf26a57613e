#!/usr/bin/env python3
"""Evolutions by optimizers outside of natator, with the real program: tests/python/outside_again.py, after ./setup.sh --readers and mvn verify.

The example of the Python client evolves, dies half-way and goes on; natator.evolve does the same into a run folder; the kinds of gaits that an export
counts are those of Java's map-elites. Exit code 1 where it fails; a minute on two idle cores.
"""
import csv
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "sim-native/python"))
os.environ.update(NATATOR=str(ROOT / "build/release/bin/natator"), NATATOR_SIM=str(ROOT / "build/release/bin/natator-sim"),
                  PYTHONPATH=str(ROOT / "sim-native/python"), TQDM_DISABLE="1")

import natator  # noqa: E402
from natator.external import EvolvedRun  # noqa: E402

RESULTS = ("evaluations.jsonl", "checkpoint.json", "generations.csv", "best.json")
SHORT = ["--no-cache", "--simulator", "resident", "--workers", "2"]
SMALL = ["--scene", "bench/small-tank", "--scheme", "conserving", "--duration", "0.1", "--population", "6", "--generations", "4", "--seed", "3", "--starts", "2"]


def expect(holds, otherwise):
    if not holds:
        sys.exit(f"outside_again.py: {otherwise}")


def ended(command, code=0):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    expect(done.returncode == code, f"{command} ended with {done.returncode}, expected {code}: {done.stderr}")
    return done.stdout


def same(one, other):
    for name in RESULTS:
        expect((one / name).read_bytes() == (other / name).read_bytes(), f"{name} differs between {one} and {other}")


def lines(run):
    file = run / "evaluations.jsonl"
    return len(file.read_text().splitlines()) if file.is_file() else 0


def asks_and_tells(folder):
    example = [sys.executable, ROOT / "sim-native/python/examples/ask_tell.py"]
    ended([*example, folder / "whole", *SMALL, *SHORT])
    dying = subprocess.Popen(list(map(str, [*example, folder / "killed", *SMALL, *SHORT])), stderr=subprocess.PIPE, text=True)
    while lines(folder / "killed") < 20:  # in its second generation
        expect(dying.poll() is None, "the run was over before it was killed")
        time.sleep(0.01)
    dying.send_signal(signal.SIGKILL)
    said = dying.stderr.read()  # to the end of natator, which holds it, too
    expect("; what was simulated before is kept, and natator resume goes on from there" in said.splitlines()[-1], said)
    ended([*example, folder / "killed", *SHORT])
    same(folder / "whole", folder / "killed")
    ended([os.environ["NATATOR"], "page", folder / "whole", "--output", folder / "whole.html"])
    expect((folder / "whole.html").stat().st_size > 10**5, "the run has no page")


def evolves(folder):
    class Dying:
        """The optimizer within, which breaks when it is told of the second generation."""

        def __init__(self, within):
            self.within, self.left = within, 1

        def ask(self):
            return self.within.ask()

        def tell(self, *told):
            self.left -= 1
            if self.left < 0:
                raise ZeroDivisionError
            self.within.tell(*told)

    from natator.evolution import _cma_es
    same_request = {"creature_or_scene": "bench/small-tank", "generations": 3, "population": 4, "starts": 1, "duration": 0.1, "scheme": "conserving",
                    "arguments": SHORT, "seed": 2}
    whole = natator.evolve(run=folder / "python", **same_request)
    broken = folder / "broken"
    try:
        natator.evolve(run=broken, optimizer=Dying(_cma_es(4, 4, 2)), **same_request)
        expect(False, "an error of the optimizer is lost")
    except ZeroDivisionError:
        pass
    again = natator.evolve(run=broken, **same_request)
    same(folder / "python", broken)
    expect(repr(whole).replace(str(folder / "python"), str(broken)) == repr(again), f"{whole} is not {again}")
    expect(whole.best["fresh"]["base"]["runs"] == 4, f"no verdict of fresh runs: {whole}")
    expect(EvolvedRun.read(broken).gait == again.gait, "the winner is another")
    by_kinds = natator.evolve(run=folder / "kinds", optimizer="cma-me", **same_request)
    expect("optimizer" in json.loads((folder / "kinds/config.json").read_text()), str(by_kinds))


def counts_kinds(folder):
    """Of a run of one start each; with several, Java forgets the gaits that its map does not hold."""
    natator_program, run = os.environ["NATATOR"], folder / "map"
    ended([natator_program, "evolve", "--optimizer", "map-elites", "--output-dir", run, *SMALL[:-2], *SHORT])
    told = json.loads(ended([natator_program, "show", "--json", run])).get("elites", [])
    expect(len(told) > 1, "a map of one gait is no test")
    for name in ("archive", "tensorboard", "mlflow", "optuna"):
        ended([sys.executable, "-m", "natator", "export", run, "--format", name, *["--fresh", "1"] * (name == "archive")])
    with open(run / "export-archive/archive.csv", newline="") as rows:
        archive = [(float(row["objective"]), float(row["measures_0"]), float(row["measures_1"])) for row in csv.DictReader(rows)]
    expect([worth for worth, _, _ in archive] == [one["worth"] for one in sorted(told, key=lambda one: (one["beats"], one["cost"]))],
           f"kinds {archive} are not those of {told}")
    metrics = json.loads((run / "export-archive/metrics.json").read_text())
    expect(metrics["kinds"] == len(told) and metrics["corrected_kinds"] <= len(told), str(metrics))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as made:
        asks_and_tells(pathlib.Path(made))
        evolves(pathlib.Path(made))
        counts_kinds(pathlib.Path(made))
    print("outside_again.py: all well")
