"""natator.evolve: what it asks for, how it chooses, and what it says of the winner."""

import json
import sys
import tempfile
import types
import unittest
from pathlib import Path
from unittest import mock

import natator
from natator import evolution
from natator.source import source

TANK = "bench/small-tank"
SUBSTEPS = 4  # of that scene
FREQUENCIES = [[0.2], [0.6], [0.4], [0.8]]  # as genes


class Given:
    """An optimizer that asks for the same gaits in each generation, and keeps what it is told."""

    def __init__(self, genes=None):
        self.genes = genes if genes is not None else [frequency + [0.5] * 4 for frequency in FREQUENCIES]
        self.told = []

    def ask(self):
        return self.genes

    def tell(self, genes, costs):
        self.told.append((genes, costs))


class Answering:
    """In place of Simulator: each swim's distance is a function of its request. What it was asked is in `requests`."""

    def __init__(self, distance):
        self.distance, self.requests = distance, []

    def __call__(self, *_):
        return self

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def evaluate_all(self, requests):
        self.requests.append(requests)
        distances = map(self.distance, requests)
        return [{"status": "ok" if way is not None else "unstable", "distance": way, "scheme": "conserving"} for way in distances]


def evolved(distance, **options):
    answering, optimizer = Answering(distance), Given()
    with mock.patch.object(evolution, "Simulator", answering):
        return natator.evolve(TANK, optimizer=optimizer, **options), answering.requests, optimizer.told


def frequency(request):
    return request["gait"]["frequency"]


class EvolveTest(unittest.TestCase):
    def test_the_same_for_any_number_of_workers(self):
        one, two = (natator.evolve(TANK, generations=2, population=4, starts=1, duration=0.1, seed=3, workers=workers) for workers in (1, 2))
        self.assertEqual((one.gait, one.distances, one.half_step, one.selected), (two.gait, two.distances, two.half_step, two.selected))
        other = natator.evolve(TANK, generations=2, population=4, starts=1, duration=0.1, seed=4)
        self.assertNotEqual(one.gait, other.gait)
        self.assertEqual(one.swim(duration=0.05).gait, one.gait)
        self.assertNotEqual(one.distances, one.half_step)

    def test_starts_are_fresh_in_each_generation_and_for_the_report(self):
        result, asked, _ = evolved(frequency, generations=3, starts=2, overrides={"solver": {"numIterations": 3}})
        self.assertEqual([len(requests) for requests in asked], [8, 8, 8, 10, 4, 4])
        starts = [{request["start"] for request in requests} for requests in asked]
        self.assertEqual([len(numbers) for numbers in starts], [2, 2, 2, 2, 4, 4])
        self.assertEqual(len(set().union(*starts)), 2 + 2 + 2 + 2 + 4)
        self.assertEqual(starts[4], starts[5])
        self.assertEqual(asked[4][0]["overrides"], {"solver": {"numIterations": 3}})
        self.assertEqual(asked[5][0]["overrides"], {"solver": {"numIterations": 3, "substeps": 2 * SUBSTEPS}})
        self.assertEqual(frequency(asked[5][0]), result.gait.frequency)

    def test_the_optimizer_is_told_means_and_that_unstable_gaits_are_worth_nothing(self):
        seen = set()

        def distance(request):
            if frequency(request) > 1.6:
                return None
            again = frequency(request) in seen
            seen.add(frequency(request))
            return frequency(request) + again
        result, _, told = evolved(distance, generations=1, starts=2)
        self.assertEqual(told[0][0], Given().genes)
        for cost, expected in zip(told[0][1], (-0.8 - 0.5, -1.4 - 0.5, -1.1 - 0.5, 0)):
            self.assertAlmostEqual(cost, expected)
        self.assertAlmostEqual(result.gait.frequency, 1.4)

    def test_a_lucky_gait_is_found_out(self):
        """The one that was best once is chosen no more when it runs again."""
        runs = {}

        def distance(request):
            runs[frequency(request)] = runs.get(frequency(request), 0) + 1
            return 5.0 if frequency(request) < 1 and runs[frequency(request)] == 1 else frequency(request)
        result, _, told = evolved(distance, generations=1, starts=1)
        self.assertEqual(min(told[0][1]), -5)
        self.assertAlmostEqual(result.gait.frequency, 1.7)
        self.assertEqual(result.distances, [result.gait.frequency] * 4)

    def test_what_it_keeps_of_the_search(self):
        result, _, _ = evolved(lambda request: frequency(request) + request["start"] // 2 % 2, generations=3, starts=1)
        self.assertEqual(len(result.history), 3)
        self.assertEqual([best for best, _ in result.history], sorted(best for best, _ in result.history))
        self.assertAlmostEqual(result.history[0][1], (0.8 + 1.4 + 1.1 + 1.7) / 4 + result.history[0][0] - 1.7)
        with tempfile.TemporaryDirectory() as folder:
            result.save(Path(folder, "some.json"))
            saved = json.loads(Path(folder, "some.json").read_text())
            self.assertEqual(source(TANK, Path(folder, "some.json")).gait, result.gait.to_json())
        self.assertEqual((saved["scene"], saved["verdict"], saved["distances"]), (TANK, repr(result), result.distances))
        self.assertEqual(saved["history"], [list(one) for one in result.history])

    def test_what_cannot_be_used(self):
        for options, message in [
                ({"generations": 0}, "^generations = 0: must be a whole number from 1 on$"), ({"starts": 1.5}, "^starts = 1.5: must be"),
                ({"population": 1}, "^population = 1: must be a whole number from 2 on$"), ({"seed": 0}, "^seed = 0: must be"),
                ({"seed": 2**32}, "^seed = 4294967296: must be below 2..32$"), ({"duration": -1}, r"duration = -1(\.0)?: must be"),
                ({"workers": -2}, "^workers = -2: must be"), ({"creature_or_scene": "pool/water"}, "must have a creature with actuators$"),
                ({"optimizer": Given([[0.5] * 3])}, r"^optimizer.ask\(\) gave \[0.5, 0.5, 0.5\]: must be 5 numbers in \[0, 1\]$"),
                ({"optimizer": Given([[0.5] * 4 + [1.1]])}, r"must be 5 numbers in \[0, 1\]$"),
                ({"optimizer": Given([])}, r"^optimizer: ask\(\) gave no candidate: must be a list of at least one$"),
                ({"optimizer": Given(5)}, r"^optimizer.ask\(\) gave 5: must be a list of lists of numbers$"),
                ({"optimizer": Given("abc")}, r"^optimizer.ask\(\) gave abc: must be a list of lists of numbers$"),
                ({"optimizer": "cma-me", "scheme": "flex"}, "^optimizer = cma-me: must be another in scheme flex"),
                ({"optimizer": 5}, "^optimizer = 5: must be cma-es, map-elites, cma-me, or an object with ask and tell$")]:
            with self.subTest(options), self.assertRaisesRegex(natator.InputError, message) as raised:
                natator.evolve(**{"creature_or_scene": TANK, "generations": 1, **options})
            self.assertNotIn("\n", str(raised.exception))
        with mock.patch.dict(sys.modules, {"cma": None}), self.assertRaisesRegex(natator.InputError, "^evolve: .* cma is missing: pip install cma$"):
            natator.evolve(TANK)

    def test_progress_is_shown_if_there_is_tqdm(self):
        bar = mock.MagicMock()
        bar.__enter__.return_value = bar
        bar.__iter__.return_value = iter(range(2))
        with mock.patch.dict(sys.modules, {"tqdm": types.SimpleNamespace(tqdm=mock.Mock(return_value=bar))}):
            evolved(frequency, generations=2)
        self.assertEqual([call.args for call in bar.set_postfix_str.call_args_list], [("best 1.700",)] * 2)
        with mock.patch.dict(sys.modules, {"tqdm": None}):
            self.assertEqual(len(evolved(frequency, generations=2)[2]), 2)


class VerdictTest(unittest.TestCase):
    def verdict(self, distances, half, scheme="conserving"):
        return repr(natator.Evolved("some", None, 0.0, distances, half, 2.0, 0.5, scheme, {}))

    def test_each(self):
        self.assertEqual(self.verdict([0.2, 0.3, 0.2, 0.3], [0.2] * 4), "swims: 0.250 ± 0.029 body lengths/s, 0.20 at half the time step")
        for verdict, end in [(self.verdict([0.2, 0.2], [0.2, None]), "; a run was unstable"), (self.verdict([0.2, 0.2], [0.09, 0.1]), "; the time step makes it"),
                             (self.verdict([0.2, 0.2], [0.31, 0.31]), "; the time step makes it"),
                             (self.verdict([0.2, 0.2], [0.2, 0.2], "flex"), "; scheme flex does not keep momentum")]:
            self.assertTrue(verdict.startswith("may swim: 0.200 ± 0.000 body lengths/s, ") and verdict.endswith(end), verdict)
        for distances in ([0.02, 0.02], [0.2, -0.1], [0.2, None], [-0.2, -0.2]):
            self.assertTrue(self.verdict(distances, [0.2, 0.2]).startswith("does not swim, or the runs differ too much to tell: "))


if __name__ == "__main__":
    unittest.main()
