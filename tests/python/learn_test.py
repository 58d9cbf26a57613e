"""The example that learns to swim, in small."""

import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

SCRIPT = Path(__file__).parents[2] / "sim-native/python/examples/learn.py"
SMALL = ["--scene", "bench/small-tank", "--num-envs", "4", "--steps", "16", "--rollouts", "8", "--duration", "0.4", "--backend", "cpu",
         "--vary", '{"settling": {"updates": 2}}', '{"settling": {"updates": 2}, "solver": {"substeps": 4}}',
         "--check", '{"settling": {"updates": 2}, "solver": {"substeps": 3}}', '{"settling": {"updates": 2}, "solver": {"substeps": 6}}']


class LearnTest(unittest.TestCase):
    def run_in(self, folder):
        done = subprocess.run([sys.executable, SCRIPT, folder, *SMALL], capture_output=True, text=True, timeout=300,
                              env={**os.environ, "JAX_PLATFORMS": "cpu"})
        self.assertEqual(done.returncode, 0, done.stderr)
        return [line for line in done.stdout.splitlines() if "body lengths" in line]

    def test_it_learns_and_swims_what_it_has_learned(self):
        with tempfile.TemporaryDirectory() as folder:
            told = self.run_in(folder)
            self.assertEqual([line.split(": ")[0] for line in told], ["bench/small-tank, overrides {'settling'"] * 2)
            self.assertNotEqual(*(line.split("body")[0].split("}: ")[1] for line in told))  # other steps, other swims
            with open(f"{folder}/curve.csv", newline="") as file:
                head, *rows = csv.reader(file)
            self.assertEqual((head, sum(int(row[1]) for row in rows)), (["seconds", "episodes", "mean_return"], 8))
            with np.load(f"{folder}/policy.npz") as policy:
                shapes = [policy[name].shape for name in policy]
            self.assertEqual(shapes, [(31, 64), (64,), (64, 64), (64,), (64, 2), (2,)])
            self.assertEqual(self.run_in(folder), told, "what is learned swims again with the same bits")


if __name__ == "__main__":
    unittest.main()
