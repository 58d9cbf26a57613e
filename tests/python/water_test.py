"""The water on a grid: its derivatives against closed forms, its message against the particles and the lattice."""

import struct
import tempfile
import unittest
from pathlib import Path

import natator
import numpy as np
from natator.water import Water

CELL = 0.075
LATTICE = {"scene": "lake/creature-2", "overrides": {"solver": {"substeps": 16}, "fluid": {
    "count": [60, 24, 24], "spacing": CELL, "origin": [CELL / 2] * 3, "mass": {"bottom": CELL ** 3 * 1000}}}}


def turning(shape, velocity_of):
    """Water whose velocity is a function of the place."""
    cell, corner = 0.1, np.array([-0.3, 0.2, 0.5])
    places = corner + cell * (np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), -1) + 0.5)
    return Water(0.0, cell, corner, velocity_of(places), np.ones(shape)), places


class DerivativesTest(unittest.TestCase):
    def test_what_turns_like_a_body_has_twice_its_rate_as_vorticity(self):
        rate = np.array([0.3, -1.1, 0.7])
        water, _ = turning((5, 6, 7), lambda places: np.cross(rate, places))
        np.testing.assert_allclose(water.vorticity(), np.broadcast_to(2 * rate, (5, 6, 7, 3)), atol=1e-12)
        np.testing.assert_allclose(water.q_criterion(), rate @ rate, rtol=1e-12)

    def test_what_strains_has_a_negative_q_and_what_shears_none(self):
        water, _ = turning((4, 4, 4), lambda places: places * [1, -0.5, -0.5])
        np.testing.assert_allclose(water.q_criterion(), -0.75, rtol=1e-12)
        np.testing.assert_allclose(water.vorticity(), 0, atol=1e-12)
        water, _ = turning((4, 5, 4), lambda places: places[..., [1]] * [2, 0, 0])
        np.testing.assert_allclose(water.q_criterion(), 0, atol=1e-12)
        np.testing.assert_allclose(water.vorticity(), np.broadcast_to([0, 0, -2], (4, 5, 4, 3)), atol=1e-12)

    def test_plane_flow_does_not_change_along_y(self):
        water, _ = turning((4, 1, 5), lambda places: np.cross([0, 1.5, 0], places))
        np.testing.assert_allclose(water.vorticity(), np.broadcast_to([0, 3, 0], (4, 1, 5, 3)), atol=1e-12)
        np.testing.assert_allclose(water.q_criterion(), 2.25, rtol=1e-12)

    def test_a_row_of_cells_has_no_derivatives(self):
        water, _ = turning((1, 4, 4), lambda places: places)
        with self.assertRaisesRegex(natator.InputError, "1 x 4 x 4 cells: must have 2 along each axis"):
            water.vorticity()


class PressureTest(unittest.TestCase):
    def test_what_stands_in_resting_water_is_taken_off(self):
        water, places = turning((5, 6, 7), np.zeros_like)
        pressure = 9.81 * (1 - places[..., 1]) + 3 * places[..., 0]
        density = np.ones((5, 6, 7))
        pressure[0, 0, 0], density[4, 5, 6] = np.nan, 0
        water = Water(0.0, water.cell, water.corner, water.velocity, density, pressure)
        excess = water.excess_pressure()
        np.testing.assert_allclose(excess[:, 1:5], 3 * (places - places[2, 0, 0])[:, 1:5, :, 0], atol=1e-12)
        self.assertEqual((excess[0, 0, 0], excess[4, 5, 6]), (0, 0))

    def test_between_cells_it_is_interpolated_and_at_the_ends_as_there(self):
        water, places = turning((5, 1, 7), np.zeros_like)
        inside = [[-0.17, 0.25, 0.83], [0.02, 0.25, 1.0]]
        np.testing.assert_allclose(water.at(places, inside), inside, atol=1e-12)
        np.testing.assert_allclose(water.at(places[..., 2], [[-9, 0, 9]]), [places[0, 0, -1, 2]])

    def test_a_neutral_body_at_rest_is_held_up_by_its_weight(self):
        """Scheme conserving: the force on all of it, over frames in which it hardly moves, is what changes its momentum."""
        with natator.Stream("open-water/creature-2", fields=("velocity", "force")) as stream:
            body, step = stream.scene["body"], stream.scene["timeStep"]
            mass = np.array(stream.scene["mass"], float)[body, None]
            gravity = np.array(stream.scene["definition"]["solver"].get("gravity", [0, -9.81, 0]))
            self.assertEqual(np.abs(stream.frame.force).max(), 0)
            for _ in range(5):
                before = (mass * stream.frame.velocity[body]).sum(0)
                stream.step(1)
                change = ((mass * stream.frame.velocity[body]).sum(0) - before) / step
                force, weight = stream.frame.force[body].sum(0, dtype=float), mass.sum() * gravity
                np.testing.assert_allclose(force + weight, change, atol=1e-3 * np.linalg.norm(weight))
                self.assertGreater(force[1], 0.5 * np.linalg.norm(weight))
            first, count = stream.scene["fluid"]
            self.assertEqual(np.abs(stream.frame.force[first:first + count]).max(), 0)

    def test_resting_water_bears_what_is_above_it(self):
        with natator.Stream("open-water/creature-2") as stream:
            self.assertTrue(np.isnan(stream.water().pressure).all())  # before the first frame
            stream.step(40)
            water, solver = stream.water(), stream.scene["definition"]["solver"]
            density = stream.scene["mass"][stream.scene["fluid"][0]] / stream.scene["fluidRestDistance"] ** 3
        far_from_the_body = water.pressure[2:6, 1:-1, 3:-3].mean((0, 2))
        found = np.polyfit(water.centres(1)[1:-1], far_from_the_body, 1)[0]
        self.assertLess(abs(found / (density * solver["gravity"][1]) - 1), 0.03)

    def test_flex_knows_neither(self):
        with natator.Stream("thesis/tank") as stream:
            self.assertIsNone(stream.water().pressure)
            with self.assertRaisesRegex(natator.InputError, "pressure: scheme flex has none; must be conserving or lattice"):
                stream.ask({"do": "water", "pressure": True})
        with self.assertRaisesRegex(natator.InputError, "fields: scheme flex knows no force; must be conserving or lattice"):
            natator.Stream("thesis/tank", fields=("position", "force"))


class MessageTest(unittest.TestCase):
    def test_cells_are_where_the_message_says(self):
        velocity, density = np.arange(3 * 24, dtype="f4").reshape(4, 3, 2, 3), np.arange(24, dtype="f4").reshape(4, 3, 2)
        body = struct.pack("<6I5d", 1, 7, 2, 3, 4, 0, 0.5, 0.1, 1, 2, 3) + velocity.tobytes() + density.tobytes()
        water = Water.from_message(body)
        self.assertEqual((water.time, water.cell, water.corner.tolist()), (0.5, 0.1, [1, 2, 3]))
        np.testing.assert_array_equal(water.velocity[1, 2, 3], velocity[3, 2, 1])
        self.assertEqual(water.density[1, 0, 2], density[2, 0, 1])
        np.testing.assert_allclose(water.centres(2), [3.05, 3.15, 3.25, 3.35])
        self.assertIsNone(water.pressure)
        pressure = np.arange(100, 124, dtype="f4").reshape(4, 3, 2)
        pressed = Water.from_message(body[:20] + struct.pack("<I", 1) + body[24:] + pressure.tobytes())
        np.testing.assert_array_equal(pressed.density, water.density)
        self.assertEqual(pressed.pressure[1, 0, 2], pressure[2, 0, 1])
        for damaged in (body[:-4], body + bytes(4), body[:20] + struct.pack("<I", 1) + body[24:], body[:63], body[:8] + struct.pack("<I", 5) + body[12:]):
            with self.assertRaises(ValueError):
                Water.from_message(damaged)

    def test_particles_that_rest_are_water_of_rest_density(self):
        with natator.Stream("thesis/tank", scheme="conserving") as stream:
            water = stream.water()
        inside = water.density[2:-2, 2:-2, 2:-2]
        self.assertGreater(inside.size, 500)
        np.testing.assert_allclose(inside.mean(), 1, atol=0.02)
        self.assertLess(np.abs(water.velocity).max(), 0.5)

    def test_a_lattice_shows_its_cells_and_a_body_in_them(self):
        with natator.Stream(**LATTICE, fields=("position", "velocity")) as stream:
            stream.set_gait(natator.gait.wave_in(stream.scene))
            self.assertEqual(np.abs(stream.water().velocity).max(), 0)
            stream.step(12)
            water, frame, body = stream.water(), stream.frame, stream.scene["body"]
        self.assertEqual((water.cell, water.density.shape), (CELL, (60, 24, 24)))
        np.testing.assert_allclose(water.density, 1, atol=0.1)
        cells = np.floor((frame.position[body] - water.corner) / water.cell).astype(int)
        own = water.velocity[tuple(cells.T)]
        # Not more, as what has streamed in since they were told the body's velocity is theirs, too.
        self.assertGreater(np.corrcoef(own.ravel(), frame.velocity[body].ravel())[0, 1], 0.95)
        self.assertGreater(np.abs(water.vorticity()).max(), 1)

    def test_files(self):
        import pyvista

        with natator.Stream("bench/small-tank") as stream, tempfile.TemporaryDirectory() as folder:
            stream.step(5, drive=[1, -1])
            water, folder = stream.water(), Path(folder)
            for name in ("water.npz", "water.vti"):
                water.save(folder / name)
            with np.load(folder / "water.npz") as kept:
                for name in ("time", "cell", "corner", "velocity", "density", "pressure")[:6 if water.pressure is not None else 5]:
                    np.testing.assert_array_equal(kept[name], getattr(water, name))
            grid = pyvista.read(folder / "water.vti")
            at = grid.find_containing_cell(water.corner + water.cell * np.array([2.5, 3.5, 1.5]))
            np.testing.assert_array_equal(grid["velocity"][at], water.velocity[2, 3, 1])
            self.assertAlmostEqual(grid["Q"][at] / water.q_criterion()[2, 3, 1], 1, places=5)
            with self.assertRaisesRegex(natator.InputError, "must end in .npz or .vti"):
                water.save(folder / "water.txt")


if __name__ == "__main__":
    unittest.main()
