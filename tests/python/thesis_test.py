"""The thesis again: rules by which gaits win, swim and bear conclusions out; that what is asked of the simulator is what is meant."""

import csv
import gzip
import json
import math
import pathlib
import re
import statistics
import sys
import tempfile
import unittest

import natator
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "results/thesis"
sys.path += [str(ROOT / "results"), str(PAGE)]

import claims  # noqa: E402
import lake  # noqa: E402
import measured  # noqa: E402
from natator import motion  # noqa: E402
import plan  # noqa: E402
import run  # noqa: E402
from claims import FAILS, HOLDS, OPEN, Trend  # noqa: E402
from measured import Sample  # noqa: E402


def about(mean):
    return Sample.of([mean, mean + 0.01, mean - 0.01, mean])


def trend(*means):
    return Trend(about(0.10), [about(mean) for mean in means])


class Conclusions(unittest.TestCase):
    def test_what_falls_hinders_unless_it_rises_on_the_way(self):
        for means, outcome in (((0.10, 0.08, 0.03), HOLDS), ((0.20, 0.03), OPEN), ((0.03, 0.10), FAILS), ((0.15,), FAILS)):
            self.assertEqual(outcome, trend(*means).hinders(), means)

    def test_going_backwards_is_no_standing_still_and_slowing_leaves_half(self):
        self.assertEqual([FAILS, HOLDS], [trend(-0.09).stops(), trend(0.005).stops()])
        self.assertEqual([HOLDS, FAILS, FAILS], [trend(mean).slows_a_little() for mean in (0.07, 0.03, 0.10)])

    def test_unstable_is_what_hardly_swims_and_what_swims_by_chance_is_open(self):
        wild = Trend(about(0.10), [Sample.of([0.3, -0.1, 0.2, -0.05])])
        self.assertEqual([HOLDS, FAILS, HOLDS, OPEN], [one.is_unstable() for one in (trend(0.005), trend(0.05), trend(-0.05), wild)])
        self.assertEqual([OPEN, HOLDS], [Trend(about(0.10), [about(0.005)], [about(other)]).is_unstable() for other in (0.005, 0.05)])

    def test_one_recording_leaves_a_quarter_open(self):
        self.assertEqual([HOLDS, OPEN, OPEN, FAILS], [claims.surely(value, 2) for value in (2.6, 2.4, 1.7, 1.5)])

    def test_a_body_that_rises_is_not_straight(self):
        rows = [{"largestYaw": 0.1, "end": {"roll": -0.2}, "heights": [0.8, 1.2], "speed": 0.25, "simulated": 4.0}]
        yaw, roll, rise = claims.straightness(rows)
        self.assertEqual((5.7, 11.5, 0.4), (round(yaw, 1), round(roll, 1), round(rise, 1)))

    def test_no_difference_is_said_only_where_one_would_show(self):
        wild = Sample.of([0.0, 0.2, 0.05, 0.15])
        self.assertEqual([HOLDS, FAILS, OPEN], [Trend(usual, [other]).makes_no_difference() for usual, other in
                                                ((about(0.2), about(0.2)), (about(0.2), about(0.14)), (wild, wild))])
        self.assertEqual([True, False], [Trend(one, []).swims for one in (Sample.of([0.05, 0.2, 0.1, 0.15]), wild)])

    def test_several_tests_agree_or_are_open(self):
        self.assertEqual([HOLDS, OPEN, claims.VOID], [claims.agreed([HOLDS, HOLDS]), claims.agreed([HOLDS, FAILS]), claims.agreed([], claims.VOID)])


class Numbers(unittest.TestCase):
    def test_an_error_bar_covers_starts_time_step_and_spacing(self):
        """Student's t of 3 degrees of freedom is 3.182 at 97.5 %."""
        four = Sample.of([0.30, 0.32, 0.28, 0.30])
        self.assertAlmostEqual(3.182 * math.sqrt(0.0008 / 3) / 2, four.interval, 5)
        self.assertEqual([0.1, 0.15, four.interval], [measured.Speed(0.3, four.interval, *changes).error for changes in
                                                      ((-0.1, math.nan), (0.0, -0.15), (math.nan, math.nan))])

    def test_a_row_that_was_cut_off_is_asked_for_again(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "rows.jsonl"
            log = measured.Log(file)
            asked = [{"id": 0, "scene": "a", "start": start} for start in (1, 2)]
            for one in asked:
                log.add({"request": one, "result": {}})
            whole = file.read_text()
            file.write_text(whole[:-5])
            again = measured.Log(file)
            self.assertEqual(whole[:-5], file.read_text(), "reading changes nothing, as another program may be writing")
            self.assertEqual([asked[1]], again.missing([*asked, {**asked[1], "start": 2.0}]))
            again.add({"request": asked[1], "result": {}})
            self.assertEqual(whole, file.read_text())
            packed = file.with_name("rows.jsonl.gz")
            packed.write_bytes(gzip.compress(whole.replace('"a"', '"b"').encode()))
            both = measured.Log(file)
            self.assertEqual([asked[0], {**asked[0], "scene": "b"}], [both.find(one)["request"] for one in (asked[0], {**asked[0], "scene": "b"})])
            packed.write_bytes(packed.read_bytes()[:-4])
            with self.assertRaisesRegex(ValueError, "rows.jsonl.gz: .*; expected a whole compressed file"):
                measured.Log(file)


class Finalists(unittest.TestCase):
    def evaluations(self, *swims):
        """(generation, gait, way); None: unstable."""
        return [{"generation": generation, "genes": [gait], "gait": {"frequency": gait}, "result":
                 {"status": "unstable"} if way is None else {"status": "ok", "distance": way}} for generation, gait, way in swims]

    def kept(self, found):
        return [(one["score"], one["runs"]) for one in found]

    def test_what_a_run_that_goes_on_finds_counts_once(self):
        first = self.evaluations((0, 1, 0.5), (0, 1, 0.75), (0, 1.5, 0.25), (0, 1.5, 0.25), (0, 3, 9), (0, 4, 9), (0, 4, None))
        since = self.evaluations((1, 1, 0.25), (1, 2, 1), (1, 2, 0.5))
        late = self.evaluations((2, 2, 0.25), (2, 2, 0.25), (2, 1.5, None))
        before = run.ranked(first)
        self.assertEqual([(0.625, 2), (0.25, 2)], self.kept(before), "neither a single run nor an unstable one")
        then = run.joined(before, since)
        self.assertEqual([(0.75, 2), (0.5, 3), (0.25, 2)], self.kept(then))
        self.assertEqual([(0.5, 4), (0.5, 3)], self.kept(run.joined(then, late)))
        self.assertEqual([(0.5, 3), (0.5, 4)], self.kept(run.ranked(first + since + late)), "of all at once")


def swims(*ways, **more):
    return [{"status": "ok", "distance": way, "stopped": "completed", **more} for way in ways]


class Verdicts(unittest.TestCase):
    GOOD = {"water": swims(2.0, 2.02), "resting": swims(0.0, 0.01), "vacuum": swims(0.001, 0.0), "half-step": swims(1.9, 2.1),
            "mirrored": swims(2.0, 1.98), "no-clamp": swims(1.8, 1.9)}

    def test_each_control_can_fail(self):
        unstable = [{"status": "unstable", "stopped": "unstable"}, *swims(2.0)]
        for changed, sign, words in (
                ({}, "✔", "swims: 0.501 ± 0.004"), ({"water": swims(0.03, 0.05)}, "✘", "less than 0.05"),
                ({"vacuum": swims(-2, -2.1)}, "✘", "1.0 times as far in vacuum, the other way"),
                ({"vacuum": swims(0.5, 1.4)}, "–", "times as far in vacuum"),
                ({"no-clamp": swims(0.1, 0.1)}, "✘", "the acceleration clamp moves it; without, 5 %"),
                ({"half-step": swims(3.3, 3.4)}, "–", "at half the time step it has 167 % of its way"),
                ({"mirrored": swims(0.5, 0.5)}, "–", "mirrored 25 % of its way is left"), ({"cpu": swims(0.5, 0.5)}, "–", "on cpu 25 %"),
                ({"water": swims(0.1, 4.0)}, "–", "its runs differ too much to tell"),
                ({"water": swims(0.4, 0.4, stopped="touched-plane")}, "–", "the wall is nearer than 0.5 body lengths"),
                ({"mirrored": unstable}, "–", "1 of 2 runs was unstable mirrored")):
            verdict = measured.judged({**self.GOOD, **changed}, 1.0, 4.0, None, 0.9)
            self.assertEqual(sign, verdict[0], (changed, verdict))
            self.assertIn(words, verdict[1])
        self.assertIn("it skims: 30 %", measured.judged(self.GOOD, 1.0, 4.0, 0.3, 0.9)[1])
        for finer, words in ((0.45, "at half the spacing it has 45 % of its speed"), (math.nan, "it has no stable run at half the spacing")):
            sign, said = measured.judged(self.GOOD, 1.0, 4.0, None, finer)
            self.assertEqual(("–", True), (sign, words in said), said)

    def test_each_control_of_a_lake_can_fail(self):
        found, eel = lake.Lake(PAGE / "nowhere"), ("creature-4", 1)
        found.motions = {"creature-4": {"bodyLength": 1.0}, "creature-2": {"bodyLength": 1.0}}
        good = {"water": (0.8, 0.82), "resting": (0.0,), "vacuum": (0.0,), "half step": (0.7,), "half cells": (0.9,), "mirrored": (0.78,), "until walls": (0.8, 0.81)}
        for changed, sign, words in (
                ({}, "✔", "swims"), ({"water": (0.02, 0.03), "until walls": ()}, "✘", "no further"), ({"vacuum": (-0.5,)}, "✘", "in vacuum"),
                ({"half step": (0.3,)}, "–", "37 % of its speed at half the step"), ({"half cells": (1.3,)}, "–", "161 % of its speed at half the cells and steps"),
                ({"mirrored": (0.3,)}, "–", "37 % of its speed mirrored"), ({"water": (0.1, 1.6), "until walls": ()}, "–", "differ too much")):
            found.runs = {eel: {name: swims(*ways, simulated=2.0) for name, ways in {**good, **changed}.items()}}
            verdict = found.verdict(eel)
            self.assertEqual((sign, True), (verdict[0], words in verdict[1]), (changed, verdict))
        for wider, touching, verdict in (
                (None, ("until walls",), ("–", "it touches walls")), ((0.8, 0.9), ("until walls",), ("✔", "swims by every control")),
                ((0.8, 0.9), ("until walls", "wider"), ("–", "it touches walls")), ((0.3, 0.3), ("until walls",), ("–", "37 % of its speed in a wider lake"))):
            ways = {**good, **({"wider": wider} if wider else {})}
            found.runs = {eel: {name: swims(*own, simulated=2.0, **({"stopped": "touched-plane"} if name in touching else {})) for name, own in ways.items()}}
            self.assertEqual(verdict, found.verdict(eel))
        ends = ("creature-2", 1)  # touching a wall ends its runs, so that it can't push off
        found.runs = {ends: {name: swims(*own, simulated=2.0, stopped="touched-plane") for name, own in {**good, "until walls": (), "wider": (0.8, 0.9)}.items()}}
        self.assertEqual(("✔", "swims by every control"), found.verdict(ends))


class Motion(unittest.TestCase):
    def test_an_eel_is_an_eel(self):
        """Its spine does not lie about its line of best fit, which gives it an e of up to 0.04."""
        times, x = np.arange(0, 2, 1 / 60), np.linspace(0, 1, 41)
        z = motion.lateral(0, x, times[:, None], 1.0, 1.5)
        swimming = motion.Swimming(np.stack(np.broadcast_arrays(3 - x, 0.5, z), axis=-1))
        eel, mackerel = (motion.fit(swimming, times, fish, 1.5) for fish in (0, 1))
        self.assertLess(eel["error"], 0.04)
        self.assertLess(eel["error"], mackerel["error"] / 2)
        self.assertAlmostEqual(1, eel["alpha"], delta=0.1)
        self.assertAlmostEqual(math.sqrt(swimming.measured / swimming.length) / 3, eel["none"], delta=0.01)

    def test_attitude_is_that_of_a_turned_body(self):
        body = np.random.default_rng(1).normal(size=(30, 3))
        c, s = math.cos(0.3), math.sin(0.3)
        about_x, about_y = np.array([[1, 0, 0], [0, c, -s], [0, s, c]]), np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
        np.testing.assert_allclose([[0, 0, 0], [0.3, 0, 0], [0, 0.3, 0]], motion.attitude(np.stack([body, body @ about_x.T, body @ about_y.T + 7])),
                                   atol=1e-12)

    def test_water_that_turns_has_its_vorticity(self):
        """Rigid rotation about the axis that points at the viewer: twice its rate, against the clock as the picture is seen."""
        i, k = np.meshgrid(np.arange(8) * motion.CELL, np.arange(6) * motion.CELL, indexing="ij")
        cells = np.stack([-0.7 * k, 0.7 * i], axis=-1).tolist()
        cells[2][3] = None
        for view, sign in (("SIDE", 1), ("ABOVE", -1)):
            turns = motion.vorticity({"view": view, "velocity": cells})
            self.assertTrue(math.isnan(turns[2, 3]))
            np.testing.assert_allclose(sign * 1.4, turns[np.isfinite(turns)])

    def test_a_recording_gives_the_committed_fit(self):
        """From the spine of a committed recording, which has six decimals; motions.jsonl has runs from starts beside it."""
        with gzip.open(PAGE / "recordings/thesis-4.json.gz", "rt", encoding="utf-8") as text:
            recording = json.load(text)
        runs = [row for row in map(json.loads, (PAGE / "motions.jsonl").read_text(encoding="utf-8").splitlines())
                if row["request"]["gait"] == recording["request"]["gait"] and row["request"]["scheme"] == "flex"
                and "fluid" not in row["request"]["overrides"]]
        swimming = motion.Swimming(np.array(recording["spine"]["centres"]))
        self.assertAlmostEqual(runs[0]["bodyLength"], swimming.length, 5)
        for fish in range(3):
            found = motion.fit(swimming, np.array(recording["spine"]["times"]), fish, recording["request"]["gait"]["frequency"])
            self.assertAlmostEqual(statistics.fmean(row["fits"][fish]["error"] for row in runs), found["error"], delta=0.001)


class Asked(unittest.TestCase):
    """Every parameter's own value is the scene's, and the simulator takes every extreme."""

    def test_parameters(self):
        for water in plan.WATERS:
            asked = plan.Plan(plan.Size(duration=1 / 60, runs=1)).of(plan.subject_of(plan.GAITS[0], water), "water").request
            asked = plan.merged(asked, {"settling": {"updates": 2}})
            ranges = {name: ways[water] for name, (_, ways) in plan.PARAMETERS.items() if water in ways}
            own = [plan.merged(asked, plan.set_to(name, value)) for name, (value, _) in ranges.items()]
            extremes = [plan.merged(asked, plan.set_to(name, value)) for name, (_, values) in ranges.items() for value in (values[0], values[-1])]
            with natator.Simulator(2) as simulator:
                plain, *found = [one["hash"] for one in simulator.evaluate_all([asked, *own])]
                simulator.evaluate_all(extremes)
            self.assertEqual({name: plain for name in ranges}, dict(zip(ranges, found)), water)
            for name, (value, values) in ranges.items():
                self.assertIn(value, values)
                self.assertEqual(sorted(set(values)), list(values), name)

    def test_numbers_of_flex_are_those_of_the_file_that_is_named(self):
        file, = set(re.findall(r"[\w.-]+/[\w./-]+", " ".join(plan.THESIS["about"])))
        with open(ROOT / file, encoding="utf-8") as lines:
            rows = {row["name"]: float(row["v_0_4"]) for row in csv.DictReader(lines)}
        for one in (one for gait in plan.GAITS for one in gait["flex"]):
            speeds = [speed for name, speed in rows.items() if re.fullmatch(one["runs"], name)]
            self.assertAlmostEqual(one["mean"], statistics.fmean(speeds), delta=5e-7, msg=one["runs"])
            if one.get("deviation") is not None:
                self.assertAlmostEqual(one["deviation"], statistics.stdev(speeds), delta=1e-6, msg=one["runs"])

    def test_what_is_asked_is_what_was_measured(self):
        """Of a study of which everything is there nothing is missing."""
        found = measured.Study(PAGE, plan.Size())
        self.assertEqual(40, len(found.finished()))
        self.assertEqual([], found.measurements.missing([one for experiment in found.experiments() for one in experiment.runs()]))
        winners = [measured.canonical(one.gait) for one in found.evolved()]
        self.assertEqual(40, len(set(winners)))

    def test_gaits_evolved_in_the_lakes_that_are_asked_for(self):
        for name in lake.LAKES:
            for seed in lake.seeds(name):
                config = json.loads((PAGE / f"lake/{name}/seed-{seed}/config.json").read_text(encoding="utf-8"))
                self.assertEqual((lake.scene(name), lake.tank(name)), (config["scene"], config["overrides"]))


if __name__ == "__main__":
    unittest.main()
