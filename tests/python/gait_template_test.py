"""The gaits that `natator-sim info SCENE --gait-template` writes."""

import json
import subprocess
import unittest

import natator
from natator.program import simulator_path
from schemas import validator

VACUUM = {"fluid": None, "movingTank": None, "settling": {"updates": 0}}


def info(*arguments):
    return subprocess.run([simulator_path(), "info", *arguments, "--json"], capture_output=True, check=True).stdout


def template(scene):
    return json.loads(info(scene, "--gait-template", "--overrides", json.dumps(VACUUM)))


class GaitTemplateTest(unittest.TestCase):
    def test_every_bundled_creature_takes_its_own(self):
        creatures = [scene for scene in json.loads(info())["scenes"] if json.loads(info(scene, "--definition")).get("creature")]
        self.assertGreater(len(creatures), 30)
        requests = []
        for scene in creatures:
            with self.subTest(scene):
                gait = template(scene)
                validator("gait.schema.json").validate(gait)
                requests.append({"scene": scene, "gait": gait, "duration": 0.02, "overrides": VACUUM})
        with natator.Simulator(workers=1, arguments=["--no-cache"]) as simulator:
            results = simulator.evaluate_all(requests)
        self.assertEqual({result["status"] for result in results}, {"ok"})

    def test_it_swims(self):
        self.assertGreater(natator.evaluate("pool/tadpole", template("pool/tadpole"), duration=1)["distance"], 0.1)


if __name__ == "__main__":
    unittest.main()
