"""natator.swim: what is told of a swim and how it is drawn."""

import json
import os
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path
from unittest import mock

import natator
import numpy as np
from natator import swimming
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
TANK = "bench/small-tank"
GAIT = natator.Gait(1.861, [0.973, 0.69], [0, 0.648])
SVG = "{http://www.w3.org/2000/svg}"


def crossing(distance, positions):
    """A Swim of a body of two slices of two particles, four in all, at such places."""
    scene = {"slices": [[0, 1], [2, 3]], "body": [0, 1, 2, 3], "bodyLength": 1.0}
    positions = np.array(positions, float)
    rest = [None] * 2
    trajectory = natator.Trajectory(np.arange(len(distance)) / 10, np.array(distance, float), None, positions, *rest, np.arange(4),
                                    slice(4, 4), scene)
    return natator.Swim("lake/some", GAIT, trajectory)


class SwimTest(unittest.TestCase):
    def test_its_numbers_are_those_of_an_evaluation(self):
        swim = natator.swim(TANK, duration=0.2, gait=GAIT, start=2, scheme="conserving")
        result = natator.evaluate(TANK, GAIT, duration=0.2, start=2, scheme="conserving")
        self.assertEqual((swim.distance, swim.duration, swim.work), (result["distance"], result["simulated"], result["work"]))
        self.assertEqual(swim.speed, swim.distance / swim.duration / swim.trajectory.scene["bodyLength"])
        self.assertEqual(repr(swim), f"{TANK}: {swim.distance:.3f} in 0.20 s, {swim.speed:.2f} body lengths/s")
        self.assertIsNone(natator.swim(TANK, duration=0.02, scheme="flex").work)
        self.assertAlmostEqual(natator.swim(TANK, duration=0.25).duration, 0.25)  # an odd number of frames

    def test_each_creature_swims_by_its_own_gait(self):
        gaits = ROOT / "sim-native/examples/gaits"
        for name in ("creature-1", "creature-2", "creature-3", "creature-4", "eel", "ray", "tadpole", "tuna"):
            swim = natator.swim(name, duration=0.02)
            own = gaits / f"{swimming.GAITS.get(name, name)}.json"
            self.assertEqual(own.is_file(), name not in ("ray", "tadpole", "tuna"))
            with self.subTest(name):
                self.assertEqual(swim.scene, f"pool/{name}")
                if own.is_file():
                    self.assertEqual(swim.gait.amplitude, json.loads(own.read_text())["amplitude"])
                else:
                    self.assertEqual(len(swim.gait.amplitude), swim.trajectory.scene["actuators"])
        for creature, scene in swimming.ELSEWHERE.items():
            self.assertTrue((ROOT / f"sim-native/scenes/{scene}.json").is_file(), creature)

    def test_a_gait_for_another_body_is_not_taken(self):
        swim = natator.swim("eel", duration=0.02, overrides={"creature": {"profile": {"joints": [0.3, 0.5, 0.7, 0.9]}}})
        self.assertEqual(len(swim.gait.amplitude), swim.trajectory.scene["actuators"])
        self.assertLess(len(swim.gait.amplitude), 8)

    def test_what_cannot_be_used(self):
        for use, message in [
                (lambda: natator.swim(3), "^creature_or_scene = 3: must be a name or a path$"),
                (lambda: natator.swim("shark"), '^unknown scene "pool/shark"'),
                (lambda: natator.swim("pool/water"), '^scene "pool/water": must have a creature with actuators$'),
                (lambda: natator.swim(TANK, duration=0), "^duration = 0: must be above 0 s$"),
                (lambda: natator.swim(TANK, gait={"frequency": 1}), "gait"),
                (lambda: crossing([0, 1], np.zeros((2, 4, 3))).save("swim.mp4"), "^file = 'swim.mp4': must end in .svg, .html, .gif or .png$")]:
            with self.assertRaisesRegex(natator.InputError, message) as raised:
                use()
            self.assertNotIn("\n", str(raised.exception))


class DrawingTest(unittest.TestCase):
    BODY = np.array([[0, 0, 0.1], [0, 0, -0.1], [1, 0, 0.2], [1, 0, -0.2]])

    def places(self, swim):
        """The body's outline in each frame of the picture, in pixels: T × corners × 2."""
        values = xml.fromstring(swim._repr_html_()).find(f".//{SVG}animate").get("values")
        return np.array([[point.split(",") for point in frame.split()] for frame in values.split(";")], float)

    def test_the_outline_is_that_of_the_slices(self):
        waved = self.BODY + [0, 0, 0.1] * np.array([[1], [1], [0], [0]])
        first, second = self.places(crossing([0, 0], [self.BODY, waved]))
        pixel = (first[:, 0].max() - first[:, 0].min())  # of a length
        corners = (first - first.mean(0)) / pixel
        np.testing.assert_allclose(corners, [[-0.5, -0.1], [0.5, -0.2], [0.5, 0.2], [-0.5, 0.1]], atol=1e-3)
        np.testing.assert_allclose((second - first) / pixel, [[0, 0.1], [0, 0], [0, 0], [0, 0.1]], atol=1e-3)

    def test_a_tank_that_moves_along_does_not_take_the_body_back(self):
        ahead = [self.BODY + [x, 0, 0.01 * k] for k, x in enumerate((0, 0.3, 0.2, 0.5))]
        first, *_, last = self.places(crossing([0, 0.3, 0.6, 0.9], ahead))  # the tank went 0.4 along
        length = first[:, 0].max() - first[:, 0].min()
        np.testing.assert_allclose((last - first)[:, 0] / length, 0.9, atol=1e-3)

    def test_nor_to_its_side(self):
        swim = crossing([0, 0, 0], [self.BODY + [0, 0, z] for z in (0, 0.1, -0.2)])  # the tank went 0.4 to the side
        swim.trajectory.scene["definition"] = {"movingTank": {"along": "xz", "step": 0.4}}
        first, second, last = self.places(swim)
        length = first[:, 0].max() - first[:, 0].min()
        np.testing.assert_allclose((last - first)[:, 1] / length, 0.2, atol=1e-3)
        np.testing.assert_allclose((second - first)[:, 1] / length, 0.1, atol=1e-3)

    def test_who_beats_up_and_down_is_seen_from_the_side(self):
        up = self.BODY[:, [0, 2, 1]]
        first, second = self.places(crossing([0, 0], [up, up + [0, 0.3, 0] * np.array([[1], [1], [0], [0]])]))
        self.assertLess(second[:, 1].min(), first[:, 1].min())  # upwards is upwards

    def test_files(self):
        swim = natator.swim(TANK, duration=0.2, gait=GAIT)
        with tempfile.TemporaryDirectory() as folder:
            for name in ("swim.svg", "swim.html", "swim.gif", "swim.PNG"):
                swim.save(Path(folder, name))
            self.assertIn(repr(swim), xml.parse(Path(folder, "swim.svg")).getroot().find(f"{SVG}title").text)
            self.assertTrue(Path(folder, "swim.html").read_text().endswith(Path(folder, "swim.svg").read_text()))
            with Image.open(Path(folder, "swim.gif")) as film, Image.open(Path(folder, "swim.PNG")) as still:
                self.assertEqual(film.n_frames, len(swim.trajectory.time))
                self.assertEqual(film.size, still.size)
                colours = dict((colour, count) for count, colour in still.convert("RGB").getcolors(1 << 20))
            for wanted in (swimming.WATER, swimming.BODY):
                self.assertGreater(colours[tuple(bytes.fromhex(wanted[1:]))], 1000)
            with self.assertRaises(FileNotFoundError):
                swim.save(Path(folder, "none", "swim.svg"))

    def test_without_pillow(self):
        swim = crossing([0, 1], [self.BODY, self.BODY])
        with mock.patch.dict("sys.modules", {"PIL.Image": None}), tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(natator.InputError, "^a .png or .gif: the Python package pillow is missing: pip install pillow$"):
                swim.save(os.path.join(folder, "swim.gif"))
            self.assertEqual(os.listdir(folder), [])
            swim.save(os.path.join(folder, "swim.svg"))


if __name__ == "__main__":
    unittest.main()
