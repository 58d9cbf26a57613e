"""Several swimmers of one water: the stream's commands and PettingZoo's environment, by PettingZoo's own tests."""

import io
import unittest
import warnings
from contextlib import redirect_stdout

import gymnasium
import natator
import numpy as np
from natator.batch import Batch
from natator.zoo import SwimmersEnv
from pettingzoo.test import parallel_api_test, parallel_seed_test

# Two short swimmers side by side, of 2 and of 3 actuators.
PAIR = {"settling": {"updates": 2}, "planes": [[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [-1, 0, 0, 1.54], [0, 0, -1, 1.58]],
        "fluid": {"count": [17, 7, 17]},
        "companions": [{"creature": {"slices": [{"height": 3, "width": 3, "count": 9}], "joints": [1, 3, 5, 7],
                                     "rearCentre": [0.42, 0.42, 1.16]}}]}
CONSERVING = {**PAIR, "scheme": "conserving", "solver": {"substeps": 1}}
WATER = {"scene": "bench/small-tank", "overrides": PAIR, "duration": 0.2}


def resting(env, **more):
    return {agent: np.zeros(env.action_space(agent).shape) for agent in env.agents} | more


def play(env, seed, steps=3):
    """What so many seeded steps give, as one list of numbers."""
    for agent in env.possible_agents:
        env.action_space(agent).seed(seed)
    seen = [*env.reset(seed=seed)[0].values()]
    for _ in range(steps):
        observations, rewards, *_ = env.step({agent: env.action_space(agent).sample() for agent in env.agents})
        seen += [*observations.values(), np.array(list(rewards.values()))]
    return np.concatenate(seen)


class StreamTest(unittest.TestCase):
    def test_a_stream_and_a_batch_drive_all(self):
        with natator.Stream("bench/small-tank", overrides=CONSERVING) as stream, Batch("bench/small-tank", 2, overrides=CONSERVING) as batch:
            self.assertEqual(stream.all_actuators, [2, 3])
            for one in (stream, batch.swims[1]):
                one.sense(flow=[(1, "left")], target=(1, 0.5, 0.4), swimmer=1)
                one.set_gait(natator.Gait(2, [0.3, 0.3, 0.3], [0, 0.1, 0.2]), swimmer=1)
                self.assertEqual(one.swimmers[1]["gait"]["frequency"], 2)
            stream.step(2, drive=[0.1, 0.2])
            senses = stream.step(drive=[[0.3, 0, 0], [0.5, 0, 0]], swimmer=1)
            batch.swims[1].step(2, drive=[0.1, 0.2])
            together = batch.swims[1].step(drive=[[0.1, 0.2, 0.3, 0, 0], [0.1, 0.2, 0.5, 0, 0]])
            for one, other in zip((senses, *senses.companions), (together, *together.companions), strict=True):
                np.testing.assert_array_equal(one.numbers(), other.numbers())
            np.testing.assert_array_equal(senses.companions[0].drive, [0.5, 0, 0])
            self.assertEqual(senses.companions[0].flow.shape, (1, 3))
            self.assertGreater(senses.companions[0].work, 0)
            np.testing.assert_array_equal(natator.Senses.from_numbers(senses.numbers(), [2, 3]).numbers(), senses.numbers())
            state = stream.save()
            ahead = stream.step(2)
            self.assertEqual(batch.swims[0].restore(state).frame, 4)
            again = batch.swims[0].step(2)
            for one, other in zip((again, *again.companions), (ahead, *ahead.companions), strict=True):
                np.testing.assert_array_equal([*one.centre, one.distance, *one.bend, one.work], [*other.centre, other.distance, *other.bend, other.work])
            stream.steer(scale=[0.5] * 3, swimmer=1)
            for wrong, reason in (({"drive": [1, 1], "swimmer": 1}, "swimmer 1: drive has length 2: must have length 3"),
                                  ({"drive": [1, 1, 1], "swimmer": 2}, r"swimmer = 2: must be in \[0, 1\]"),
                                  ({"drive": [0, 0, 0, 9, 0]}, r"swimmer 1: drive\[1\] = 9: must be"),
                                  ({"drive": [0, np.nan]}, r"drive\[1\] = nan"), ({"drive": [0, 0], "swimmer": 0.5}, "swimmer = 0.5")):
                with self.assertRaisesRegex(natator.InputError, reason):
                    stream.step(**wrong)
            with self.assertRaisesRegex(natator.InputError, "swimmer: must be left out in a batch"):
                batch.swims[0].step(drive=[0, 0, 0], swimmer=1)


class EnvironmentTest(unittest.TestCase):
    def test_pettingzoos_tests(self):
        for more in ({}, {"actions": "gait", "target": {"swimmer-1": "swimmer-0"}}, {"overrides": CONSERVING, "work_cost": 1e-6, "others": 0}):
            with self.subTest(more), warnings.catch_warnings(), redirect_stdout(io.StringIO()):
                warnings.simplefilter("error")
                env = SwimmersEnv(**{**WATER, **more})
                parallel_api_test(env, num_cycles=10)
                env.close()
                parallel_seed_test(lambda: SwimmersEnv(**{**WATER, **more}), num_cycles=3)

    def test_the_same_seed_gives_the_same_bits(self):
        env, again = (SwimmersEnv(**WATER | {"overrides": CONSERVING}) for _ in range(2))
        first = play(env, 7)
        for seen in (play(again, 7), play(env, 7)):
            np.testing.assert_array_equal(seen, first)
        self.assertFalse(np.array_equal(play(env, 8), first))
        env.close()
        again.close()

    def test_each_is_driven_and_observed_by_itself(self):
        env = SwimmersEnv(**WATER, frames=2)
        self.assertEqual(env.possible_agents, ["swimmer-0", "swimmer-1"])
        self.assertEqual([env.action_space(agent).shape for agent in env.possible_agents], [(2,), (3,)])
        env.reset(seed=1, options={"start": 4})
        action = np.array([0.4, -0.2, 0.8])
        observations, _, _, _, infos = env.step(resting(env, **{"swimmer-1": action}))
        with natator.Stream("bench/small-tank", overrides=PAIR, start=4) as stream:
            stream.sense(flow=env._envs[0]._places)
            stream.sense(flow=env._envs[1]._places, swimmer=1)
            senses = stream.step(drive=[[0, 0, *(action / 2)], [0, 0, *action]])
        one, other = senses, senses.companions[0]
        axes = [np.stack([each.forward, each.up, each.right]) for each in (one, other)]
        length = env._envs[0].length
        for agent, own, seen, own_axes, seen_axes in (("swimmer-0", one, other, *axes), ("swimmer-1", other, one, *axes[::-1])):
            vertical = [own.forward[1], own.up[1], own.right[1]]
            expected = np.concatenate([
                own.velocity / length, own.turn_rate, vertical, own.drive, own.bend, own.flow.ravel() / length,
                own_axes @ (seen.centre - own.centre) / length, (own_axes @ seen_axes.T @ seen.velocity - own.velocity) / length,
                own_axes @ seen.forward])
            np.testing.assert_allclose(observations[agent], expected, rtol=1e-5, atol=1e-6)
            self.assertEqual(observations[agent].shape, env.observation_space(agent).shape)
            self.assertEqual(infos[agent]["distance"], own.distance)
        np.testing.assert_array_equal(other.drive, action)
        self.assertGreater(observations["swimmer-0"][-7], 1)  # the other is to the right
        self.assertLess(observations["swimmer-1"][-7], -1)
        env.close()

    def test_a_follower_is_rewarded_for_coming_nearer(self):
        env = SwimmersEnv(**WATER, target={"swimmer-1": "swimmer-0"}, reached=100)
        before, _ = env.reset(seed=1)
        after, rewards, terminated, _, infos = env.step(resting(env))
        at = slice(-13, -9)  # direction and distance, before what is seen of the other
        np.testing.assert_allclose(before["swimmer-1"][at][:3] * before["swimmer-1"][at][3], before["swimmer-1"][-9:-6], rtol=1e-5)
        self.assertAlmostEqual(rewards["swimmer-1"], float(before["swimmer-1"][at][3] - after["swimmer-1"][at][3]), 5)
        self.assertNotEqual(rewards["swimmer-1"], 0)
        self.assertAlmostEqual(rewards["swimmer-0"], infos["swimmer-0"]["distance"] / env._envs[0].length)
        self.assertFalse(any(terminated.values()))  # a swimmer that is followed is never reached
        env.close()

    def test_one_ends_and_the_other_goes_on(self):
        env = SwimmersEnv(**WATER, target={"swimmer-0": (0.75, 0.42, 0.41)})
        env.reset(seed=1)
        _, _, terminated, truncated, infos = env.step(resting(env, **{"swimmer-0": np.ones(2)}))
        self.assertEqual((terminated, truncated), ({"swimmer-0": True, "swimmer-1": False}, {"swimmer-0": False, "swimmer-1": False}))
        self.assertTrue(infos["swimmer-0"]["reached"])
        self.assertEqual(env.agents, ["swimmer-1"])
        with self.assertRaisesRegex(natator.InputError, "actions: swimmer-0 swims no more"):
            env.step({"swimmer-0": np.zeros(2), "swimmer-1": np.zeros(3)})
        observations, *_ = env.step({"swimmer-1": np.ones(3)})
        self.assertEqual(list(observations), ["swimmer-1"])
        np.testing.assert_array_equal(env._senses[0].drive, [0, 0])  # slack
        while env.agents:
            _, _, terminated, truncated, _ = env.step(resting(env))
        self.assertEqual((terminated, truncated), ({"swimmer-1": False}, {"swimmer-1": True}))
        self.assertEqual(env.step({}), ({}, {}, {}, {}, {}))
        self.assertEqual(len(env.reset(seed=2)[0]), 2)
        env.step(resting(env))
        env._stream.ask({"do": "overrides", "overrides": {"solver": {"relaxationMode": "global"}}})
        while env.agents:
            observations, _, terminated, _, infos = env.step(resting(env, **{"swimmer-1": np.ones(3)} if "swimmer-1" in env.agents else {}))
        self.assertTrue(infos["swimmer-1"]["unstable"] and terminated["swimmer-1"] and np.all(np.isfinite(observations["swimmer-1"])))
        env.close()

    def test_resets_take_a_state_and_overrides(self):
        env = SwimmersEnv(**WATER)
        env.reset(seed=1)
        env.step(resting(env, **{"swimmer-1": np.ones(3)}))
        state = env.save()
        ahead = env.step(resting(env))[0]
        _, infos = env.reset(seed=5, options={"state": state})
        self.assertAlmostEqual(infos["swimmer-0"]["time"], 0.05)
        env._action[1] = np.ones(3)
        np.testing.assert_array_equal(env.step(resting(env))[0]["swimmer-1"], ahead["swimmer-1"])
        first = env.reset(seed=5, options={"start": 3})[0]
        env.reset(seed=5, options={"start": 3, "overrides": {"solver": {"viscosity": 2}}})
        self.assertEqual(env._stream.scene["definition"]["solver"]["viscosity"], 2)
        with self.assertRaisesRegex(natator.InputError, "options: 'strt' is unknown"):
            env.reset(options={"strt": 1})
        with self.assertRaisesRegex(natator.InputError, "the scene would have 1 swimmers: must have 2"):
            env.reset(options={"overrides": {"companions": []}})
        env.reset(seed=5)
        with self.assertRaisesRegex(natator.InputError, "actions = None: must be a dict, by agent"):
            env.step(None)
        self.assertEqual(first["swimmer-0"].shape, env.observation_space("swimmer-0").shape)
        env.close()

    def test_it_is_drawn(self):
        env = SwimmersEnv(**WATER, render_mode="rgb_array")
        self.assertEqual(env.metadata["render_fps"], 20)
        env.reset(seed=1)
        pixels = env.render()
        self.assertEqual((pixels.shape, pixels.dtype), ((400, 640, 3), np.uint8))
        for colour in ((31, 111, 139), (109, 159, 113)):  # the first, its companion
            self.assertTrue(np.any(np.all(pixels[:200] == colour, axis=2)), colour)
        env.close()
        blind = SwimmersEnv(**WATER)
        self.assertIsNone(blind.render())
        blind.close()

    def test_what_is_wrong_names_the_agent(self):
        for more, reason in (({"actions": {"swimmer-1": "push"}}, "swimmer-1: actions = 'push'"), ({"flow": {"swimmer-1": 50}}, "swimmer-1: flow = 50"),
                             ({"actions": {"swimmer-7": "gait"}}, "actions: 'swimmer-7' is no agent; must be one of swimmer-0, swimmer-1"),
                             ({"target": {"swimmer-1": "swimmer-1"}}, "target of swimmer-1 = 'swimmer-1': must be another agent"),
                             ({"target": {"swimmer-1": (9, 0.4, 0.6)}}, r"swimmer-1: target = \[9.0, 0.4, 0.6\]: must be in the tank"),
                             ({"others": 2}, "others = 2: must be at most 1, as there are 2 swimmers"), ({"duration": 0}, "duration = 0"),
                             ({"actions": "gait", "gait": {"swimmer-1": natator.Gait(1, [1], [0])}}, "swimmer-1: gait.amplitude has length 1"),
                             ({"render_mode": "ansi"}, "render_mode = 'ansi'"), ({"scene": "thesis/tank", "overrides": {}}, "swimmer-0: scene .* must have a creature")):
            with self.assertRaisesRegex(natator.InputError, reason):
                SwimmersEnv(**{**WATER, **more})
        env = SwimmersEnv(**WATER)
        with self.assertRaises(gymnasium.error.ResetNeeded):
            env.step({})
        env.reset(seed=1)
        for action, reason in (([0, 0, np.nan], r"swimmer-1: action\[2\] = nan: must be a finite number"),
                               ([0, 0], r"swimmer-1: action \[0.0, 0.0\]: must be 3 numbers in \[-1, 1\]")):
            with self.assertRaisesRegex(natator.InputError, reason):
                env.step(resting(env, **{"swimmer-1": np.array(action)}))
        with self.assertRaisesRegex(natator.InputError, "actions: swimmer-1 is missing: must be of swimmer-0, swimmer-1"):
            env.step({"swimmer-0": np.zeros(2)})
        self.assertEqual(env._stream.sense().frame, 0)  # none has moved
        env.close()


if __name__ == "__main__":
    unittest.main()
