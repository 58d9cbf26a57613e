"""Policies that were learned: their file, and the closed loop of natator-sim stream --policy."""

import json
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import natator
from natator.gym import SwimmerEnv
from natator.policy import Policy
from natator.program import simulator_path

SCENE = {"scene": "bench/small-tank", "overrides": {"settling": {"updates": 2}}, "frames": 3, "reached": 0.1}
GAIT = {"frequency": 2, "amplitude": [0.6, 0.4], "phase": [0, 0.6]}
KINDS = [{"actions": "drive", "gait": None, "flow": [[1, "left"], [2, "right"]], "target": None},
         {"actions": "gait", "gait": GAIT, "flow": [], "target": [[1.2, 0.5, 0.4], [1.4, 0.5, 0.6]]}]


class PolicyTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.file = Path(self.folder.name) / "policy.json"

    def save(self, environment, inputs, outputs):
        random = np.random.default_rng(3)
        layers = [{"weights": random.normal(0, 0.3, shape).round(5).tolist(), "bias": random.normal(0, 0.3, shape[1]).round(5).tolist()}
                  for shape in ((inputs, 8), (8, outputs))]
        self.file.write_text(json.dumps({"environment": environment, "layers": layers}))
        return Policy(self.file)

    def test_the_simulator_swims_by_it_as_the_environment_does(self):
        for kind in KINDS:
            with self.subTest(kind["actions"]), SwimmerEnv(**SCENE, **kind) as env:
                policy = self.save(SCENE | kind, env.observation_space.shape[0], env.action_space.shape[0])
                observation, _ = env.reset(seed=4, options={"start": 2})
                with natator.Stream(SCENE["scene"], overrides=SCENE["overrides"], start=2, arguments=["--policy", str(self.file)]) as stream:
                    stream.sense(target=env._point)
                    for _ in range(6):
                        observation, _, _, _, info = env.step(policy(observation))
                        senses = stream.step(3)
                        np.testing.assert_allclose(senses.centre, info["centre"], atol=1e-9)
                    self.assertGreater(np.abs(senses.drive).max(), 0.05)

    def test_it_ends_where_others_drive_and_begins_anew_with_a_start(self):
        with SwimmerEnv(**SCENE, **KINDS[0]) as env:
            self.save(SCENE | KINDS[0], env.observation_space.shape[0], 2)
        with natator.Stream(SCENE["scene"], overrides=SCENE["overrides"], arguments=["--policy", str(self.file)]) as stream:
            swims = []
            for _ in range(2):
                stream.reset()
                swims.append([stream.step(3).drive.tolist() for _ in range(4)])
            self.assertEqual(*swims)
            stream.step(3, drive=[0.25, 0])
            self.assertEqual(stream.step(3).drive.tolist(), [0.25, 0])

    def test_it_drives_a_stream_that_runs_and_a_film(self):
        with SwimmerEnv(**SCENE, **KINDS[1]) as env:
            self.save(SCENE | KINDS[1], env.observation_space.shape[0], 4)
        options = {"overrides": SCENE["overrides"], "duration": 0.2}
        stepped = natator.record(SCENE["scene"], fields=("position",), arguments=["--policy", str(self.file)], **options)
        film = natator.swim(SCENE["scene"], policy=self.file, **options).trajectory
        np.testing.assert_array_equal(film.position, stepped.position[::2])
        command = [simulator_path(None), "stream", SCENE["scene"], "--policy", self.file, "--overrides", json.dumps(SCENE["overrides"]),
                   "--fields", "none", "--rate", "0", "--until", "0.2", "--lossless"]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as program:
            program.stdin.write(b'{"do":"credit","frames":100}\n')
            program.stdin.flush()
            told, drives = program.stdout.read(), []
        while told:
            size, = struct.unpack_from("<I", told, 4)
            if told.startswith(b"FRAM"):
                drives.append(struct.unpack_from("<2f", told, 8 + 72))
            told = told[8 + size:]
        np.testing.assert_array_equal(drives, stepped.drive)
        self.assertGreater(np.ptp(stepped.drive), 0.05)

    def test_it_begins_anew_at_a_saved_moment(self):
        with SwimmerEnv(**SCENE, **KINDS[1]) as env:
            self.save(SCENE | KINDS[1], env.observation_space.shape[0], 4)
        with natator.Stream(SCENE["scene"], overrides=SCENE["overrides"]) as stream:
            stream.set_gait(GAIT | {"frequency": 1})
            stream.step(6)
            state = stream.save()
            alone = stream.step(6).drive.tolist()
        with natator.Stream(SCENE["scene"], overrides=SCENE["overrides"], arguments=["--policy", str(self.file)]) as stream:
            stream.step(2)  # in the middle of an action
            swims = []
            for _ in range(2):
                stream.restore(state)
                swims.append([stream.step(2).drive.tolist() for _ in range(3)])
            self.assertEqual(stream.scene["gait"]["frequency"], GAIT["frequency"])
        self.assertEqual(*swims)
        self.assertNotEqual(swims[0][-1], alone)

    def test_a_gait_beside_it_is_refused(self):
        with SwimmerEnv(**SCENE, **KINDS[0]) as env:
            self.save(SCENE | KINDS[0], env.observation_space.shape[0], 2)
        with self.assertRaisesRegex(natator.InputError, "gait: must be left out with a policy"):
            natator.swim(SCENE["scene"], gait=GAIT, policy=self.file)
        with self.assertRaisesRegex(natator.InputError, "--gait: must be left out with --policy"):
            natator.Stream(SCENE["scene"], gait=GAIT, arguments=["--policy", str(self.file)])

    def test_what_is_no_policy_is_refused_in_a_line(self):
        good = {"environment": SCENE | KINDS[0], "layers": [{"weights": [[0, 0]] * 19, "bias": [0, 0]}]}
        for change, why in (({"layers": []}, "layers: must be one layer at least"),
                            ({"layers": [{"weights": [[0, 0]] * 19, "bias": [0]}]}, "layers[0].bias: must have a number for each column of weights"),
                            ({"layers": [{"weights": [[0, 0]] * 18, "bias": [0, 0]}]},
                             "--policy: has 18 inputs and 2 outputs; must have 19 and 2 for this body"),
                            ({"environment": SCENE | KINDS[1] | {"target": None, "gait": GAIT | {"amplitude": [0.6, 1.6]}}},
                             "--policy: gait.amplitude[1] and the size of its offset are 1.6 together; must be at most 1.5"),
                            ({"environment": good["environment"] | {"flow": 3}}, "environment.flow = 3: must be a list of slices and sides"),
                            ({"environment": good["environment"] | {"actions": "swim"}}, "environment.actions = \"swim\": must be \"drive\" or \"gait\"")):
            with self.subTest(why):
                self.file.write_text(json.dumps(good | change))
                done = subprocess.run([simulator_path(None), "stream", SCENE["scene"], "--policy", self.file], capture_output=True, text=True,
                                      stdin=subprocess.DEVNULL)
                self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
                self.assertIn(why, done.stderr)
        for text in ("no json", '{"layers": []}', '{"environment": {}, "layers": []}', '{"environment": {}, "layers": [{"weights": [[1]]}]}',
                     '{"environment": {}, "layers": [{"weights": [[1, 2]], "bias": [1]}]}', '{"environment": {}, "layers": [{"weights": [[NaN]], "bias": [1]}]}'):
            self.file.write_text(text)
            with self.assertRaisesRegex(natator.InputError, "must be a policy"):
                Policy(self.file)
        with self.assertRaisesRegex(natator.InputError, "No such file"):
            Policy(self.file.with_name("none"))


if __name__ == "__main__":
    unittest.main()
