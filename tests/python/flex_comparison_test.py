"""The comparison with NVIDIA Flex: its list of variants is what the measured runs say, and a study goes on where it stopped."""

import json
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "results"), str(ROOT / "results/flex-comparison")]

import make as page  # noqa: E402

# where in a scene the settings columns are
PLACES = {
    "springs_per_pair": "creature springsPerParticle", "spacing": "creature spacing", "cluster_stiffness": "creature clusterStiffness",
    "substeps": "solver substeps", "iterations": "solver numIterations", "max_acceleration": "solver maxAcceleration",
    "relaxation_mode": "solver relaxationMode", "damping": "solver damping", "relaxation_factor": "solver relaxationFactor",
    "viscosity": "solver viscosity", "dynamic_friction": "solver dynamicFriction", "radius": "solver radius",
    "particle_friction": "solver particleFriction", "solid_pressure": "solver solidPressure",
    "max_neighbours": "solver maxNeighborsPerParticle"}
# what no variant may differ in, since a scene cannot say it
FIXED = {
    "middle_springs": "False", "joints": "standard", "z_sign": "1", "moving": "True", "solid_flags": "none", "solid_group": "1",
    "solid_inverse_mass": "1.0", "cavity_distance": "0.15", "zero_normals_given": "False", "rigids_resent_every_frame": "False",
    "time_shift": "0.0", "shape_margin": "0", "particle_margin": "0", "amplitude_factor": "1.0"}
# table 3.1 of the thesis; body 2 with φ_i = frac(0.431 i), i from 1, as the rest lengths in one_frame show
THESIS = {
    "1": {"frequency": 1.861, "amplitude": [0.973, 0.69], "phase": [0, 0.648]},
    "2": {"frequency": 1.338, "amplitude": [0.504, 0.4582857143, 0.4125714286, 0.3668571429, 0.3211428571, 0.2754285714, 0.2297142857, 0.184],
          "phase": [0.431, 0.862, 0.293, 0.724, 0.155, 0.586, 0.017, 0.448]}}
LARGEST_FLOAT = 3.4028234663852886e38


def patched(target, patch):
    """JSON Merge Patch, RFC 7386."""
    if not isinstance(patch, dict):
        return patch
    result = dict(target) if isinstance(target, dict) else {}
    for key, value in patch.items():
        if value is None:
            result.pop(key, None)
        else:
            result[key] = patched(result.get(key), value)
    return result


def number(text):
    try:
        return LARGEST_FLOAT if text == "none" else float(text)
    except ValueError:
        return text


def masses(fluid):
    if fluid is None:
        return ""
    mass = fluid["mass"]
    bottom, top = mass.get("bottom", 0), mass.get("top", 1)
    return {"mass-linear": f"mass linear {bottom:g} to 1/{round(1 / top)}", "uniform": f"uniform mass {bottom:g}",
            "inverse-mass-linear": f"inverse mass linear {1 / (bottom or 1)} to {round(1 / top)}"}[mass["gradient"]]


class Variants(unittest.TestCase):
    def cases(self):
        variants = list(page.variants())
        self.assertGreaterEqual(len(variants), 24)
        for variant in variants:
            for run in variant["runs"].to_dict("records"):
                with self.subTest(variant["name"], run=run["name"]):
                    yield variant, run

    def test_settings_agree(self):
        tank = json.loads((ROOT / "sim-native/scenes/thesis/tank.json").read_text())
        creature = {"rearCentre": [0.45, 0.6, 0.6], "springsPerParticle": 4, "clusterStiffness": 0.2, "spacing": 0.075}
        for variant, run in self.cases():
            scene = patched(tank | {"creature": creature}, variant["overrides"])
            self.assertEqual(FIXED, {name: run[name] for name in FIXED})
            for column, place in PLACES.items():
                part, key = place.split()
                self.assertEqual(number(run[column]), scene[part][key], column)
            self.assertEqual([float(run["y0"]), float(run["z0"])], scene["creature"]["rearCentre"][1:])
            self.assertEqual("thesis/creature-" + run["body"], variant["scene"])
            self.assertEqual(5 if run["walls"] == "tank" else 0, len(scene["planes"]))
            self.assertEqual(-10 if run["medium"] == "fluid" else 0, scene["solver"]["gravity"][1])
            self.assertEqual(run["fluid_masses"], masses(scene.get("fluid")))
            self.assertEqual({"planeContact": False, "noProgressAfter": 0}, {key: scene["stopping"][key] for key in ("planeContact", "noProgressAfter")})

    def test_gaits_agree(self):
        for variant, run in self.cases():
            gait = dict(variant["gait"])
            self.assertEqual(float(run["power"]), gait.pop("power", 1))
            if run["phases"] == "thesis":
                order = -1 if run["actuator_order"] == "rear first" else 1
                self.assertEqual({key: value[::order] if isinstance(value, list) else value for key, value in THESIS[run["body"]].items()}, gait)
            else:
                self.assertEqual("front first", run["actuator_order"])
                self.assertEqual(float(run["frequency"]), gait["frequency"])
                for ours, column in (("amplitude", "amplitudes"), ("phase", "phases")):
                    theirs = [float(value) for value in run[column].split()]
                    self.assertEqual(len(theirs), len(gait[ours]))
                    for one, other in zip(gait[ours], theirs, strict=True):
                        self.assertAlmostEqual(one, other, delta=5e-5)


class FakeSimulator:
    asked = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def evaluate_all(self, requests):
        self.asked.extend(requests)
        return [{"status": "ok", "distance": one["duration"] * one.get("perturbation", {}).get("seed", 0), "simulated": one["duration"]}
                for one in requests]


class Study(unittest.TestCase):
    def run_study(self):
        FakeSimulator.asked = []
        page.run()
        return len(FakeSimulator.asked)

    def test_goes_on_where_it_stopped(self):
        every = list(page.variants())[:2]
        with tempfile.TemporaryDirectory() as folder, open(os.devnull, "w") as nothing, mock.patch("sys.stdout", nothing), \
                mock.patch("natator.Simulator", FakeSimulator), mock.patch.multiple(
                    page, HERE=pathlib.Path(folder), LOG=pathlib.Path(folder, "evaluations.jsonl"), variants=lambda: every):
            each = len(page.TIMES) * (page.RUNS + 1)
            self.assertEqual(2 * each, self.run_study())
            table = page.compared()
            self.assertEqual([(3.0, 0.0)] * 4, list(zip(table.ours_mean, table.ours_as_stated, strict=True)))
            self.assertEqual(0, self.run_study())
            lines = page.LOG.read_text().splitlines(keepends=True)
            page.LOG.write_text("".join(lines[:-2])[:-40])
            self.assertEqual(3, self.run_study())
            every[1] = every[1] | {"overrides": {"solver": {"damping": 0.3}}}
            self.assertEqual(each, self.run_study())
            page.LOG.write_text(page.LOG.read_text().replace('"simulator": "', '"simulator": "other'))
            self.assertEqual(2 * each, self.run_study())


if __name__ == "__main__":
    unittest.main()
