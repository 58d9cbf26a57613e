"""stream.schema.json against the program that reads the commands: what one takes the other takes."""

import re
import unittest

import natator
from jsonschema import Draft202012Validator
from schemas import FILES, ROOT, validator

LAWS = ["finite", "tank", "particle-energy", "energy", "shape", "compression", "mach"]
GAIT = {"frequency": 1, "amplitude": [0.5, 0.5], "phase": [0, 0.5]}

TAKEN = [
    {"do": "run"}, {"do": "pause", "id": 3}, {"do": "credit"}, {"do": "credit", "frames": 1000}, {"do": "reset"},
    {"do": "reset", "start": 2147483647}, {"do": "step"}, {"do": "step", "frames": 2, "drive": [0.1, -2]},
    {"do": "step", "drive": [[0, 0], [0.5, 2]], "sense": True}, {"do": "step", "scale": [0, 0.5], "offset": [0.2, 0]},
    {"do": "drive", "drive": [2, -2]}, {"do": "steer"}, {"do": "steer", "scale": [4, 0]}, {"do": "sense"},
    {"do": "sense", "flow": [{"slice": 8, "side": "below"}], "within": 1000, "target": [1, -1e6, 0.5], "each": True},
    {"do": "sense", "target": None, "flow": [], "each": False}, {"do": "water"}, {"do": "rate", "value": 0}, {"do": "rate", "value": 0.001},
    {"do": "gait", "gait": GAIT}, {"do": "overrides", "overrides": {"duration": 3}},
    {"do": "scene", "scene": "bench/small-tank", "overrides": {}, "gait": GAIT, "start": 3},
    {"do": "save"}, {"do": "restore"}, {"do": "restore", "sense": True}, {"do": "pause", "swim": 0},
    {"do": "drive", "swimmer": 0, "drive": [0, 0.1]}, {"do": "steer", "swimmer": 0}, {"do": "sense", "swimmer": 0},
    {"do": "gait", "swimmer": 0, "gait": GAIT}, {"do": "step", "swimmer": 0, "drive": [[0, 0.1]]},
    {"do": "step", "scale": [[1, 0.5], [1, 1]], "offset": [[0, 0.1], [0.1, 0]]}, {"do": "step", "offset": [[0.1, 0]]},
]
REFUSED = [
    {}, {"do": "swim"}, {"do": "run", "now": True}, {"do": "pause", "id": -1}, {"do": "credit", "frames": 1001},
    {"do": "reset", "start": 2147483648}, {"do": "reset", "start": 1.5}, {"do": "step", "frames": 0},
    {"do": "step", "drive": [0.1, 2.01]}, {"do": "step", "drive": [[0.1, 0], [0, 3]]}, {"do": "step", "sense": 1},
    {"do": "step", "drive": [0, 0], "offset": [0, 0]}, {"do": "step", "drive": [0, "a"]}, {"do": "drive"},
    {"do": "drive", "drive": 1}, {"do": "drive", "drive": [None, 0]}, {"do": "drive", "drive": [[0, 0]]},
    {"do": "steer", "drive": [0, 0]}, {"do": "steer", "scale": [4.1, 0]}, {"do": "steer", "scale": [-0.1, 0]},
    {"do": "steer", "offset": [2.5, 0]}, {"do": "sense", "flow": [{"slice": 1}]}, {"do": "sense", "within": -1},
    {"do": "sense", "flow": [{"slice": 1, "side": "port"}]}, {"do": "sense", "target": [1, 2]}, {"do": "sense", "each": 1},
    {"do": "sense", "target": [1, 2, 2e6]}, {"do": "rate"}, {"do": "rate", "value": 2000}, {"do": "gait"},
    {"do": "gait", "gait": GAIT | {"frequency": 61}}, {"do": "overrides"}, {"do": "scene"}, {"do": "scene", "scene": 3},
    {"do": "save", "sense": True}, {"do": "restore", "sense": "yes"}, {"do": "pause", "swim": -1}, {"do": "pause", "swim": 4096},
    {"do": "drive", "swimmer": -1, "drive": [0, 0]}, {"do": "drive", "swimmer": 65, "drive": [0, 0]}, {"do": "step", "swimmer": 0},
    {"do": "steer", "swimmer": 0.5}, {"do": "sense", "swimmer": "0"}, {"do": "pause", "swimmer": 0},
    {"do": "step", "scale": [[1, 1]], "offset": [0, 0]}, {"do": "step", "scale": [[1, 5]]},
]


class SchemaTest(unittest.TestCase):
    def test_each_is_one(self):
        for name, schema in FILES.items():
            with self.subTest(name):
                Draft202012Validator.check_schema(schema)

    def test_schema_and_program_take_and_refuse_the_same(self):
        schema, taken_by_program = validator("stream.schema.json"), []
        with natator.Stream("bench/small-tank") as stream:
            for command in TAKEN + REFUSED:
                with self.subTest(command):
                    try:
                        stream.ask({"do": "pause"})
                        stream.ask(command)
                        taken = True
                    except natator.InputError:
                        taken = False
                    self.assertEqual(taken, command in TAKEN)
                    self.assertEqual(schema.is_valid(command), taken)
                    taken_by_program.append(taken)
        self.assertEqual(sum(taken_by_program), len(TAKEN))

    def test_senses_fit(self):
        schema = validator("stream.schema.json#/$defs/senses")
        for scheme in ("flex", "conserving"):
            with natator.Stream("bench/small-tank", scheme=scheme) as stream:
                for command in ({"do": "step", "sense": True}, TAKEN[14]):
                    schema.validate(stream.ask(command)["senses"])
        self.assertFalse(schema.is_valid({}))

    def test_results_that_break_a_law_fit(self):
        schema = validator("result.schema.json")
        light = {"stopping": {"planeContact": False, "noProgressAfter": 0}, "fluid": {"mass": {"gradient": "uniform", "bottom": 0.02}}}
        with natator.Simulator() as simulator:
            for law, scene, overrides in [("tank", "bench/small-tank", light),
                                          ("any", "thesis/creature-1", {"solver": {"relaxationMode": "global"}})]:
                with self.subTest(scene):
                    result = simulator.evaluate(scene, GAIT, duration=0.5, overrides=overrides)
                    schema.validate(result)
                    self.assertEqual((result["status"], result["fitness"], result["distance"]), ("unstable", 0, None))
                    self.assertIn(result["unstable"]["law"], ([law] if law == "tank" else LAWS))
                    result["unstable"]["law"] = "inertia"
                    self.assertFalse(schema.is_valid(result))

    def test_every_law_is_explained(self):
        page = (ROOT / "sim-native/docs/results.md").read_text()
        table = page[page.index("### The laws"):page.index("## How far")]
        self.assertEqual(re.findall(r"^\| `([a-z-]+)` \|", table, re.MULTILINE)[1:], LAWS)


if __name__ == "__main__":
    unittest.main()
