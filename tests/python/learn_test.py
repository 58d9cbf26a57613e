"""The example that learns to swim, in small."""

import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "sim-native/python/examples/learn.py"
SMALL = ["--num-envs", "3", "--steps", "8", "--rollouts", "4", "--env", '{"duration": 0.2}', "--backend", "cpu"]


class LearnTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        compiled = cls.enterClassContext(tempfile.TemporaryDirectory())  # the same for tasks of as many inputs
        cls.environment = {**os.environ, "JAX_PLATFORMS": "cpu", "JAX_COMPILATION_CACHE_DIR": compiled, "JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS": "0"}

    def run_in(self, folder, *arguments):
        done = subprocess.run([sys.executable, SCRIPT, folder, *arguments, *SMALL], capture_output=True, text=True, timeout=300,
                              env=self.environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [line for line in done.stdout.splitlines() if "body lengths" in line]

    def test_it_learns_each_task(self):
        inputs = {"ahead": 21, "turn": 25, "station": 25}
        for task, count in inputs.items():
            with self.subTest(task), tempfile.TemporaryDirectory() as folder:
                self.run_in(folder, task)
                with open(f"{folder}/curve.csv", newline="") as file:
                    head, *rows = csv.reader(file)
                self.assertEqual((head, sum(int(row[1]) for row in rows)), (["seconds", "episodes", "mean_return"], 12))
                policy = json.loads(Path(folder, "policy.json").read_text())
                self.assertEqual([(len(layer["weights"]), len(layer["bias"])) for layer in policy["layers"]], [(count, 64), (64, 64), (64, 10)])
                self.assertEqual(policy["environment"]["scene"], "plane/loach")

    def test_it_swims_what_it_has_learned(self):
        with tempfile.TemporaryDirectory() as folder:
            told = [self.run_in(folder, "turn", "--check", '{"solver": {"substeps": 12}}') for _ in range(2)]
            self.assertEqual([line.split(": ")[0] for line in told[0]], ["turn, overrides {}", "turn, overrides {'solver'"])
            self.assertNotEqual(*(line.split(": ")[-1] for line in told[0]))  # other steps, other swims
            self.assertEqual(*told, "what is learned swims again with the same bits")
            first = Path(folder, "policy.json").read_bytes()
        with tempfile.TemporaryDirectory() as folder:
            self.run_in(folder, "turn", "--check", '{"solver": {"substeps": 12}}')
            self.assertEqual(Path(folder, "policy.json").read_bytes(), first, "a seed learns the same")


if __name__ == "__main__":
    unittest.main()
