"""natator.evolve with a run folder: what it says to the program natator, and what it makes of what that says. The program is a script here;
tests/python/outside_again.py has the real one."""

import json
import os
import pathlib
import stat
import sys
import tempfile
import unittest
from unittest import mock

import natator
from natator import evolution, external

GENES = [{"name": "frequency", "lower": 0.5, "upper": 2.0}, {"name": "amplitude 1", "lower": 0.0, "upper": 1.0}, {"name": "phase 2", "lower": 0.0, "upper": 1.0}]
BEST = {"genes": [1.0, 0.5, 0.5], "gait": {"frequency": 1.0, "amplitude": [0.5, 0.5], "phase": [0.0, 0.5]}, "fresh": {}}
# It plays its script: strings are said, others are awaited; then it ends with a code and a last line. All that it hears and is called with is kept.
NATATOR = f"""#!{sys.executable}
import json, pathlib, sys
folder = pathlib.Path(__file__).parent
with open(folder / "calls.jsonl", "a") as calls:
    print(json.dumps(sys.argv[1:]), file=calls)
if sys.argv[1] == "show":
    print(json.dumps({{"answer": ["The best gait swims.", "It does."]}}))
    sys.exit()
script = json.loads((folder / "script.json").read_text())
for line in script["say"]:
    if line is None:
        heard = sys.stdin.readline()
        with open(folder / "heard.jsonl", "a") as file:
            file.write(heard)
    else:
        print(line if isinstance(line, str) else json.dumps(line), flush=True)
print("generation 1 of 1\\nnatator " + sys.argv[1] + ": " + script["last"], file=sys.stderr)
run = pathlib.Path(sys.argv[sys.argv.index("--output-dir") + 1] if "--output-dir" in sys.argv else sys.argv[4])
run.mkdir(exist_ok=True)
(run / "config.json").write_text(json.dumps({{"scene": "bench/small-tank", "scheme": "conserving", "duration": 0.1}}))
(run / "best.json").write_text(json.dumps({BEST!r}))
sys.exit(script["code"])
"""


def begin(**more):
    return {"do": "begin", "protocol": 1, "genes": GENES, **more}


def ask(generation):
    return {"do": "ask", "generation": generation}


def tell(generation, *candidates):
    return {"do": "tell", "generation": generation, "candidates": [{"genes": genes, "status": "ok" if fitness is not None else "unstable", "fitness": fitness, **more}
                                                                  for genes, fitness, more in candidates]}


class Given:
    def __init__(self, *asked):
        self.asked, self.told = list(asked), []

    def ask(self):
        return self.asked.pop(0)

    def tell(self, *told):
        self.told.append(told)


class ExternalTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        file = self.folder / "natator"
        file.write_text(NATATOR)
        file.chmod(file.stat().st_mode | stat.S_IXUSR)
        self.enterContext(mock.patch.dict(os.environ, NATATOR=str(file)))
        self.run_folder = self.folder / "run"

    def play(self, *say, code=0, last="done"):
        (self.folder / "script.json").write_text(json.dumps({"say": say, "code": code, "last": last}))

    def lines(self, name):
        return [json.loads(line) for line in (self.folder / name).read_text().splitlines()]

    def evolve(self, optimizer, **options):
        return natator.evolve("eel", **{"generations": 2, "population": 4, "starts": 1, "duration": 0.5, "seed": 7, "optimizer": optimizer, "run": self.run_folder, **options})

    def test_a_run(self):
        self.play(begin(), ask(0), None, tell(0, ([1.0, 0.5, 1.0], 0.25, {}), ([2.0, 0.1, 0.0], None, {})), ask(1), None, tell(1, ([1.25, 0.3, 0.25], -0.5, {})), {"do": "end"})
        optimizer = Given([[1 / 3, 0.5, 1], [1, 0.1, 0]], [[0.5, 0.3, 0.25]])
        evolved = self.evolve(optimizer, workers=3, overrides={"solver": {"substeps": 2}}, scheme="conserving", arguments=["--no-cache"])
        self.assertEqual(repr(evolved), f"{self.run_folder}: The best gait swims. It does.")
        self.assertEqual((evolved.gait, evolved.best), (natator.Gait(**BEST["gait"]), BEST))
        self.assertEqual(optimizer.told, [([[1 / 3, 0.5, 1.0], [1.0, 0.1, 0.0]], [-0.25, 0.0]), ([[0.5, 0.3, 0.25]], [0.5])])
        self.assertEqual(self.lines("heard.jsonl"), [{"generation": 0, "candidates": [[1.0, 0.5, 1.0], [2.0, 0.1, 0.0]]}, {"generation": 1, "candidates": [[1.25, 0.3, 0.25]]}])
        call, show = self.lines("calls.jsonl")
        options = dict(zip(call[1:-1:2], call[2:-1:2], strict=True))
        self.assertEqual((call[0], call[-1], show), ("evolve", "--no-cache", ["show", "--json", str(self.run_folder)]))
        self.assertEqual({key: options[key] for key in ("--optimizer", "--scene", "--generations", "--population", "--starts", "--seed", "--duration", "--scheme",
                                                        "--overrides", "--workers", "--output-dir")},
                         {"--optimizer": "external", "--scene": "pool/eel", "--generations": "1", "--population": "4", "--starts": "1", "--seed": "7", "--duration": "0.5",
                          "--scheme": "conserving", "--overrides": '{"solver": {"substeps": 2}}', "--workers": "3", "--output-dir": str(self.run_folder)})
        self.assertEqual(evolved.swim(duration=0.05).gait, evolved.gait)

    def test_it_goes_on_with_what_is_recorded(self):
        """Genes that it did not ask for this time are told as shares of their ranges."""
        self.run_folder.mkdir()
        settings = {"scene": "pool/eel", "optimizer": "external", "population": 4, "starts": 1, "duration": 0.5, "seed": 7}
        (self.run_folder / "config.json").write_text(json.dumps(settings))
        self.play(begin(recorded=1), ask(0), None, tell(0, ([0.5, 0.75, 1.0], 0.25, {})), ask(1), None, tell(1, ([1.25, 0.3, 0.25], 0.5, {})), {"do": "end"})
        optimizer = Given([[0.9, 0.5, 1]], [[0.5, 0.3, 0.25]])
        self.evolve(optimizer)
        self.assertEqual(optimizer.told[0], ([[0.0, 0.75, 1.0]], [-0.25]))
        self.assertEqual([self.lines("calls.jsonl")[0][k] for k in (0, 3, 4, 5)], ["resume", str(self.run_folder), "--generations", "1"])
        (self.run_folder / "config.json").write_text(json.dumps(settings))
        with self.assertRaisesRegex(natator.InputError, "run was begun with seed 7, not 8: must be the same, or another folder$"):
            self.evolve(Given(), seed=8)

    def test_measures_are_told_to_who_wants_them(self):
        self.play(begin(), ask(0), None, tell(0, ([1.0, 0.5, 1.0], 0.25, {"measures": {"beatsPerLength": 4.0, "costOfTransport": 2.5}}), ([2.0, 0.1, 0.0], 0.1, {})), {"do": "end"})
        optimizer = Given([[1 / 3, 0.5, 1], [1, 0.1, 0]])
        optimizer.measures = True
        self.evolve(optimizer)
        self.assertEqual(optimizer.told[0][1:], ([-0.25, -0.1], [(4.0, 2.5), None]))

    def test_what_goes_wrong_is_one_line(self):
        for say, code, last, optimizer, kind, message in [
                ((begin(), ask(0), None, {"do": "end", "error": "x"}), 2, "optimizer, line 1: x", Given([[0, 0, 0]]), natator.InputError, "^optimizer, line 1: x$"),
                ((), 1, "cannot write", None, natator.ProgramError, "^cannot write$"),
                (({"do": "begin", "protocol": 2, "genes": GENES},), 0, "", None, natator.ProgramError, "^natator speaks protocol 2 to optimizers, this package 1"),
                (("hello",), 0, "", None, natator.ProgramError, r"^natator said b'hello"),
                ((begin(), ask(0), None), 0, "", Given([[0, 0]]), natator.InputError, r"^optimizer.ask\(\) gave \[0.0, 0.0\]: must be 3 numbers in \[0, 1\]$"),
                ((begin(), ask(0), None), 0, "", Given([[0, 0, float("nan")]]), natator.InputError, r"must be 3 numbers in \[0, 1\]$")]:
            self.play(*say, code=code, last=last)
            with self.subTest(message), self.assertRaisesRegex(kind, message) as raised:
                self.evolve(optimizer, run=self.folder / f"other-{len(message)}")
            self.assertNotIn("\n", str(raised.exception))
        with self.assertRaisesRegex(natator.InputError, "^start and run: expected one of them$"):
            self.evolve(None, start=3)
        with mock.patch.dict(os.environ, NATATOR="/no/natator"), self.assertRaisesRegex(natator.ProgramError, "^/no/natator: cannot be started"):
            self.evolve(None)

    def test_an_optimizer_that_fails_ends_the_program(self):
        self.play(begin(), ask(0), None, None)
        optimizer = Given()
        with self.assertRaises(IndexError):
            self.evolve(optimizer)


class MapElitesTest(unittest.TestCase):
    TANK = {"creature_or_scene": "bench/small-tank", "generations": 3, "population": 4, "starts": 1, "duration": 0.05, "scheme": "conserving"}

    def test_pyribs_keeps_the_best_of_each_kind(self):
        for kind in ("map-elites", "cma-me"):
            one, two = (natator.evolve(optimizer=kind, workers=workers, **self.TANK) for workers in (1, 2))
            frame = one.archive.data(return_type="pandas")
            self.assertGreater(len(frame), 1)
            self.assertTrue(frame.equals(two.archive.data(return_type="pandas")), kind)
            self.assertEqual((one.gait, one.distances), (two.gait, two.distances))

    def test_measures_are_those_of_the_runs(self):
        told = []

        class Wanting(Given):
            measures = True

            def tell(self, genes, costs, measures):
                told.append((genes, costs, measures))
        natator.evolve(optimizer=Wanting([[0.5] * 5, [0.2] * 5]), **{**self.TANK, "generations": 1})
        (genes, costs, measures), = told
        result = natator.evaluate("bench/small-tank", evolution._gait(genes[0], 2), duration=0.05, scheme="conserving", start=1_000_003)
        self.assertEqual(-costs[0], result["distance"])
        beats = (0.5 + 1.5 * genes[0][0]) * result["simulated"]
        with natator.Stream("bench/small-tank") as stream:
            length = stream.scene["bodyLength"]
        expected = beats / abs(result["distance"] / length), result["work"] / abs(result["distance"])
        if measures[0] is None:
            self.assertGreaterEqual(expected[0], 128)
        else:
            self.assertEqual(measures[0], expected)

    def test_what_cannot_be_used(self):
        with self.assertRaisesRegex(natator.InputError, '^optimizer = "best": must be cma-es, map-elites, cma-me, or an object with ask and tell$'):
            natator.evolve("eel", optimizer="best")
        with mock.patch.dict(sys.modules, {"ribs": None, "ribs.archives": None}), self.assertRaisesRegex(
                natator.InputError, "^optimizer cma-me: the Python package ribs is missing: pip install ribs$"):
            natator.evolve(optimizer="cma-me", **self.TANK)


if __name__ == "__main__":
    unittest.main()
