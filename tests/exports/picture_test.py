"""Pictures of a swim: what is where the projection says, and what is refused."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np
from natator import picture
from natator.errors import InputError
from natator.water import Water
from PIL import Image

TANK = "bench/small-tank"
GAIT = {"frequency": 2, "amplitude": [1, 1], "phase": [0, 0.75]}
#: of the tank's sphere of directions: one unit along x, y and z, in units to the right, up and to the viewer
SEEN = {"side": [(1, 0, 0), (0, 1, 0), (0, 0, 1)], "top": [(1, 0, 0), (0, 0, 1), (0, -1, 0)], "front": [(0, 0, 1), (0, 1, 0), (-1, 0, 0)]}


class PictureTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def drawn(self, scene=TANK, **options):
        """Pixels, and where its projection puts a place."""
        def keep(plotter):
            camera = plotter.camera
            seen.update(focus=np.array(camera.focal_point), scale=options["size"][1] / 2 / camera.parallel_scale)

        seen, screenshot = {}, picture.package("pyvista", "pyvista", "").Plotter.screenshot
        with mock.patch("pyvista.Plotter.screenshot", lambda self, **given: keep(self) or screenshot(self, **given)):
            picture.picture(scene, self.folder / "one.png", **options)
        pixels = np.array(Image.open(self.folder / "one.png").convert("RGB"), int)
        self.assertEqual(pixels.shape[1::-1], options["size"])

        def at(place):
            right, up, _ = picture._axes(*picture.VIEWS[options.get("view", "side")]) @ (np.array(place) - seen["focus"])
            return pixels[round(options["size"][1] / 2 - seen["scale"] * up), round(options["size"][0] / 2 + seen["scale"] * right)]

        return pixels, at, seen["scale"]

    def test_a_unit_is_where_it_is_seen(self):
        for view, units in SEEN.items():
            np.testing.assert_allclose(picture._axes(*picture.VIEWS[view]).T, units, atol=1e-12)
        for view in picture.VIEWS.values():
            axes = picture._axes(*view)
            np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
        self.assertTrue((picture._axes(*picture.VIEWS["three-quarter"])[2] > 0.3).all())  # shows right, top and head

    def test_a_scale_is_a_round_length(self):
        for wanted, length in ((0.3, 0.2), (0.4, 0.5), (1, 1), (8, 10), (0.033, 0.05), (14, 10)):
            self.assertAlmostEqual(picture._round(wanted), length)

    def test_a_body_in_vacuum_is_on_white(self):
        for view in picture.VIEWS:
            with self.subTest(view):
                pixels, _, _ = self.drawn("thesis/creature-1-vacuum", view=view, size=(320, 240))
                self.assertEqual(pixels[2, 2].tolist(), [255, 255, 255])
                warm = pixels[..., 0] > pixels[..., 2] + 60
                self.assertGreater(warm.mean(), 0.02)

    def test_vortices_are_seen(self):
        cells = {"solver": {"substeps": 16}, "fluid": {"count": [60, 24, 24], "spacing": 0.075, "origin": [0.0375] * 3,
                                                       "mass": {"bottom": 0.421875}}}
        gait = {"frequency": 2, "amplitude": [0.4] * 8, "phase": [0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2]}
        cold = []
        for more in ({"vortices": True}, {"water": False}):
            pixels, _, _ = self.drawn("lake/creature-2", gait=gait, overrides=cells, at=0.3, view="top", size=(500, 300), **more)
            cold.append(np.mean(pixels[..., 2] > pixels[..., 0] + 25))  # the body is warm, the floor grey
        self.assertGreater(cold[0], 0.002 + 4 * cold[1])
        with self.assertRaisesRegex(InputError, "the water does not turn anywhere"):
            self.drawn("lake/creature-2", overrides=cells, at=0, vortices=True, size=(500, 300))

    def test_a_plane_of_the_water_and_what_it_does_to_the_body_are_seen(self):
        gait = {"frequency": 2, "amplitude": [1] * 5, "phase": [0] * 5}
        red, bare = [], self.drawn("plane/loach", gait=gait, at=0.1, view="top", size=(500, 300))[0]
        for more in ({"plane": "velocity"}, {"plane": "vorticity"}, {"plane": "pressure"}, {"forces": True}, {"pressure": True}):
            pixels = self.drawn("plane/loach", gait=gait, at=0.1, view="top", size=(500, 300), **more)[0].astype(int)
            self.assertGreater((np.abs(pixels[40:] - bare[40:]).max(-1) > 30).mean(), 0.001, more)
            red.append(np.mean((pixels[..., 0] > 160) & (pixels[..., 1] < 60) & (pixels[..., 2] > 60) & (pixels[..., 2] < 140)))
        self.assertGreater(red[3], 3 * red[0] + 0.0005)  # its arrows
        with self.assertRaisesRegex(InputError, "pressure: scheme flex has none"):
            self.drawn(TANK, scheme="flex", plane="pressure")
        with self.assertRaisesRegex(InputError, "fields: scheme flex knows no force"):
            self.drawn(TANK, scheme="flex", forces=True)

    def test_the_force_of_all_parts_is_that_of_the_body_and_pressure_that_outside_of_it(self):
        swim = SimpleNamespace(solids=np.arange(4), cluster=np.array([0, 0, 1, 1]), scene={
            "body": [0, 1, 2, 3], "bodyLength": 2.0, "slices": [[0, 1], [2, 3]], "definition": {"creature": {"spacing": 0.1}}})
        frame = SimpleNamespace(position=np.array([(0, 0, -0.1), (0, 0, 0.1), (1, 0, -0.1), (1, 0, 0.1)], "f4"),
                                force=np.array([(1, 0, 0), (0, 2, 0), (0, 0, 3), (-4, 0, 0)], "f4"))
        drawn = []
        with mock.patch.object(picture, "_arrows", lambda *given, **_: drawn.extend(given[2:4])):
            self.assertIn("longest 5 mass", picture._forces(None, None, swim, frame))
        np.testing.assert_allclose(drawn[0], [(0, 0, 0), (1, 0, 0)], atol=1e-7)
        np.testing.assert_allclose(drawn[1], 0.4 * 2 / 5 * np.array([(1, 2, 0), (-4, 0, 3)]))
        z = -1 + 0.1 * (np.arange(20) + 0.5)
        water = Water(0.0, 0.1, np.array([-1.0, -0.05, -1.0]), np.zeros((30, 1, 20, 3)), np.ones((30, 1, 20)), np.broadcast_to(3 * z, (30, 1, 20)))
        np.testing.assert_allclose(picture._pressed(water, swim, frame), 3 * 0.3 * np.array([-1, 1, -1, 1]), atol=1e-6)

    def test_water_veils_what_is_behind_it_and_ends_at_the_walls(self):
        _, wet, _ = self.drawn(size=(500, 300))
        _, dry, _ = self.drawn(size=(500, 300), water=False)
        from natator import Stream
        with Stream(TANK, fields=("position",)) as stream:
            body = stream.frame.position[stream.scene["body"]].mean(0)
            walls = picture._framing(SimpleNamespace(scene=stream.scene, all_water=np.arange(sum(stream.scene["fluid"])), solids=np.array(
                stream.scene["body"])), stream.frame.position)[0]
        corner = [walls[0, 0] + 0.1, walls[0, 1] + 0.1, body[2]]
        self.assertGreater(wet(corner)[2], wet(corner)[0] + 40)
        self.assertEqual(dry(corner).tolist(), [255, 255, 255])
        self.assertEqual(wet([corner[0], walls[0, 1] - 0.03, body[2]]).tolist(), [255, 255, 255])
        self.assertGreater(dry(body)[0], dry(body)[2] + 60)
        self.assertLess(wet(body)[0] - wet(body)[2], dry(body)[0] - dry(body)[2])

    def test_a_periodic_tank_has_no_edges_at_its_ends(self):
        tank = np.array([[0, 0, 0], [2, 1, 1.0]])
        self.assertEqual(len(list(picture._edges(tank, {}))), 12)
        edges = [np.ptp(ends, axis=0) for ends in picture._edges(tank, {"z": [0, 1]})]
        self.assertEqual([edge.tolist() for edge in edges], 4 * [[0, 0, 1]])

    def test_a_short_tank_is_shown_whole_and_a_long_one_in_part(self):
        position = np.array([(0, 0, 0), (4, 1, 1), (1.9, 0.5, 0.5), (2.1, 0.5, 0.5)], "f4")
        swim = SimpleNamespace(scene={"planes": [[1, 0, 0, 0], [-1, 0, 0, 4], [0, 1, 0, 0]], "body": [2, 3], "bodyLength": 0.2},
                               all_water=np.array([0, 1]), solids=np.array([2, 3]))
        tank, shown = picture._framing(swim, position)
        np.testing.assert_allclose(tank, [[0, 0, 0], [4, 1, 1]])
        np.testing.assert_allclose(shown, [[1.78, 0, 0], [2.22, 1, 1]], rtol=1e-6)
        swim.scene["bodyLength"] = 2.4
        np.testing.assert_allclose(picture._framing(swim, position)[1], tank)
        swim.scene["planes"] = []
        np.testing.assert_allclose(picture._framing(swim, position)[1], [[-0.48] * 3, [4.48, 1.48, 1.48]], rtol=1e-6)

    def test_a_scale_is_as_long_as_it_says(self):
        pixels, _, scale = self.drawn(size=(800, 400))
        dark = np.pad((pixels[360:, :300] < 100).all(2), ((0, 0), (1, 1))).astype(int)
        runs = [np.flatnonzero(row == -1) - np.flatnonzero(row == 1) for row in np.diff(dark, axis=1)]
        self.assertAlmostEqual(max(run.max() for run in runs if len(run)) / scale / picture._round(0.14 * 800 / scale), 1, delta=0.03)

    def command(self, *arguments, env={}):
        return subprocess.run([sys.executable, "-m", "natator", "picture", *map(str, arguments)], capture_output=True, text=True,
                              cwd=self.folder, env={**os.environ, **env})

    def test_a_swim_is_drawn_at_its_time(self):
        (self.folder / "gait.json").write_text(json.dumps(GAIT))
        for name, at in (("0.png", 0), ("1.png", 0.2)):
            done = self.command(TANK, "--gait", "gait.json", "--at", at, "--size", "320x200", "-o", name)
            self.assertEqual((done.returncode, done.stdout), (0, f"{name}: 320 x 200 pixels, at {at:.2f} s\n"), done.stderr)
        start, later = (np.array(Image.open(self.folder / name), int) for name in ("0.png", "1.png"))
        self.assertEqual(start.shape, (200, 320, 3))
        self.assertGreater((start != later).any(2).sum(), 100)

    def test_a_body_at_rest_is_drawn_at_the_start_as_high_as_it_takes(self):
        done = self.command("thesis/creature-1-vacuum", "--from", "three-quarter")
        with Image.open(self.folder / "creature-1-vacuum.png") as image:
            width, height = image.size
        self.assertEqual((done.stdout, width), (f"creature-1-vacuum.png: 1600 x {height} pixels, at 0.00 s\n", 1600))

    def test_bad_usage_is_one_line(self):
        for arguments, message in (
                ("no/such", 'unknown scene "no/such"'),
                ("none.json", "none.json is neither a run folder nor a scene: there is no such file"),
                (f"{TANK} --size 10x10", "--size is 10x10; expected pixels as 1200x800, each from 64 to 4096"),
                (f"{TANK} --size 5000x800", "--size is 5000x800; expected pixels"),
                (f"{TANK} --size big", "--size is big; expected pixels"),
                (f"{TANK} --at 1.5", "--at is 1.5; expected a time of the swim, 0 to 1"),
                (f"{TANK} --at -1", "--at is -1.0; expected a time of the swim"),
                (f"{TANK} --at nan", "--at is nan; expected a time of the swim"),
                (f"{TANK} --from behind", "argument --from: invalid choice: 'behind'"),
                (f"{TANK} -o x.jpg", "--output is x.jpg; expected a name that ends in .png"),
                (f"{TANK} --place 1", "--place is 1.0; expected --slice with it"),
                (f"{TANK} --plane along", "--plane is along; expected --slice with it"),
                (f"{TANK} -o no/x.png", "no/x.png cannot be written: there is no folder no")):
            with self.subTest(arguments):
                done = self.command(*arguments.split())
                self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (2, "", 1), done.stderr)
                self.assertIn(message, done.stderr)
                self.assertEqual(os.listdir(self.folder), [])

    def test_a_missing_package_is_named(self):
        (self.folder / "pyvista.py").write_text("raise ImportError\n")
        path = os.pathsep.join([str(self.folder), os.environ.get("PYTHONPATH", "")])
        done = self.command(TANK, env={"PYTHONPATH": path})
        self.assertEqual((done.returncode, done.stderr), (2, "python -m natator: a picture: the Python package pyvista is missing: "
                                                          "pip install pyvista\n"))

    @unittest.skipUnless(sys.platform == "linux", "other systems bring what draws")
    def test_where_nothing_draws_one_line_tells_the_way_out(self):
        done = self.command(TANK, env={"__EGL_VENDOR_LIBRARY_DIRS": str(self.folder), "DISPLAY": ""})  # no driver
        self.assertEqual((done.returncode, done.stderr), (2, "python -m natator: a picture: nothing here can draw it; expected Mesa or a "
                                                          "graphics driver, with EGL (Debian: apt-get install libegl1 libgl1)\n"))


if __name__ == "__main__":
    unittest.main()
