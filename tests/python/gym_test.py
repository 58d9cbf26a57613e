"""The Gymnasium environments, by Gymnasium's own checker and against each other."""

import tempfile
import unittest
import warnings

import gymnasium
import imageio_ffmpeg
import natator
import natator.gym
import numpy as np
from gymnasium.utils.env_checker import check_env

TANK = {"scene": "bench/small-tank", "duration": 0.2}
CONSERVING = {**TANK, "overrides": {"scheme": "conserving", "settling": {"updates": 5}, "solver": {"substeps": 1}}}


def play(env, seed, steps=6):
    """Observations and rewards of so many seeded actions."""
    env.action_space.seed(seed)
    seen = [env.reset(seed=seed)[0]]
    for _ in range(steps):
        observation, reward, terminated, truncated, _ = env.step(env.action_space.sample())
        seen += [observation, reward, terminated, truncated]
    return seen


class EnvironmentTest(unittest.TestCase):
    def test_gymnasiums_checker(self):
        for more in ({}, {"actions": "gait"}, {"target": ((1, 0.3, 0.3), (1.4, 0.6, 0.5))}, CONSERVING | {"work_cost": 1e-6}):
            with self.subTest(more), warnings.catch_warnings():
                warnings.simplefilter("error")
                env = gymnasium.make("natator/Swimmer-v0", **{**TANK, **more})
                check_env(env.unwrapped)
                env.close()

    def test_a_reset_that_is_refused_half_way_leaves_nothing_to_go_on_from(self):
        env = natator.gym.SwimmerEnv(**TANK)
        env.reset(seed=1)
        with self.assertRaisesRegex(natator.InputError, "state"):
            env.reset(options={"state": b"abc"})
        env.step(np.zeros(2))  # nothing had changed
        with self.assertRaisesRegex(natator.InputError, "state"):
            env.reset(options={"overrides": {"creature": {"springStiffness": 0.5}}, "state": b"abc"})
        with self.assertRaises(gymnasium.error.ResetNeeded):
            env.step(np.zeros(2))
        env.reset(seed=1)
        env.step(np.zeros(2))
        env.close()

    def test_the_same_seed_gives_the_same_bits(self):
        for more in ({}, {"actions": "gait", "target": (1.4, 0.4, 0.6)}, CONSERVING | {"work_cost": 1e-6}):
            with self.subTest(more):
                env, again = (natator.gym.SwimmerEnv(**{**TANK, **more}) for _ in range(2))
                first = play(env, 7)
                for seen in (play(again, 7), play(env, 7)):  # by another program; by the same after a reset
                    for one, other in zip(first, seen):
                        np.testing.assert_array_equal(one, other)
                self.assertFalse(np.array_equal(first[-4], play(env, 8)[-4]))
                env.close()
                again.close()

    def test_observations_are_in_the_order_that_is_documented(self):
        env = natator.gym.SwimmerEnv(**TANK, actions="gait", target=(1.4, 0.4, 0.6), flow=[(2, "left"), (4, "right")])
        env.reset(seed=1)
        observation = env.step(np.array([1, 0, 0.5, -0.5], np.float32))[0]
        senses = env._stream.sense()
        length = env._stream.scene["bodyLength"]
        turns = 2 * np.pi * 1.5 * senses.time
        expected = np.concatenate([
            senses.velocity / length, senses.turn_rate, [senses.forward[1], senses.up[1], senses.right[1]], senses.drive,
            senses.bend, senses.flow.ravel() / length, [np.sin(turns), np.cos(turns)], senses.target,
            [senses.target_distance / length]])
        np.testing.assert_allclose(observation, expected, rtol=1e-6, atol=1e-6)
        self.assertEqual(observation.shape, env.observation_space.shape)
        env.close()

    def test_an_action_is_reached_in_a_straight_line(self):
        env = natator.gym.SwimmerEnv(**TANK, frames=4)
        env.reset(seed=1, options={"start": 5})
        env.step(np.array([0.8, -0.4]))
        with natator.Stream(TANK["scene"], start=5) as stream:
            for part in (0.25, 0.5, 0.75, 1):
                senses = stream.step(drive=[0.8 * part, -0.4 * part])
        np.testing.assert_array_equal(env._senses.centre, senses.centre)
        env.close()

    def test_rewards_are_progress_less_work(self):
        plain, target, costly = (natator.gym.SwimmerEnv(**{**CONSERVING, **more}) for more in (
            {}, {"target": (1.4, 0.4, 0.6)}, {"work_cost": 0.5}))
        for env in (plain, target, costly):
            env.reset(seed=3)
        length = plain._stream.scene["bodyLength"]
        before = target._senses.target_distance
        action = np.array([0.5, -0.5])
        (_, reward, *_, info), (_, nearer, *_), (_, dearer, *_) = (env.step(action) for env in (plain, target, costly))
        self.assertAlmostEqual(reward, info["distance"] / length)
        self.assertAlmostEqual(nearer, (before - target._senses.target_distance) / length)
        self.assertAlmostEqual(dearer, reward - 0.5 * info["work"])
        self.assertNotEqual(info["work"], 0)
        for env in (plain, target, costly):
            env.close()

    def test_the_wave_bends_a_body_one_way(self):
        for bend, amplitude in (("vertical", [0.8] * 2), ("both", [0.8, 0.8, 0, 0])):
            env = natator.gym.SwimmerEnv(**TANK, actions="gait", overrides={"creature": {"bend": bend}})
            self.assertEqual(env._stream.scene["gait"]["amplitude"], amplitude)
            self.assertEqual(env.action_space.shape, (2 * len(amplitude),))
            env.close()

    def test_episodes_end(self):
        env = natator.gym.SwimmerEnv(**TANK)
        ends = play(env, 1, steps=4)[-2:]
        self.assertEqual(ends, [False, True])  # truncated at its duration
        env.close()
        there = natator.gym.SwimmerEnv(**TANK, target=(0.75, 0.42, 0.41))
        there.reset(seed=1)
        _, _, terminated, _, info = there.step(np.zeros(2))
        self.assertTrue(terminated and info["reached"])
        there.close()
        broken = natator.gym.SwimmerEnv(**TANK, frames=50, actions="gait")
        broken.reset(seed=1)
        broken._stream.ask({"do": "overrides", "overrides": {"solver": {"relaxationMode": "global"}}})
        observation, _, terminated, _, info = broken.step(np.ones(4))
        self.assertTrue(terminated and info["unstable"] and np.all(np.isfinite(observation)))
        broken.close()

    def test_a_target_is_not_beyond_walls_that_stay(self):
        for more, target in (({"scene": "endless/creature-2"}, (30, 1, 1)), ({"scene": "thesis/creature-1-vacuum"}, (30, -1, 1)),
                             ({"scene": "endless/creature-2", "overrides": {"movingTank": {"along": None}}}, (30, 1, 1)),
                             ({"scene": "open-water/periodic"}, (30, 0.5, 0.5))):
            with self.subTest(more):
                natator.gym.SwimmerEnv(**more, target=target).close()
        with self.assertRaisesRegex(natator.InputError, r"must be in the tank, y from 0, z from 0 to 1.6$"):
            natator.gym.SwimmerEnv("endless/creature-2", target=(30, -1, 1))

    def test_bad_arguments_and_actions_are_refused(self):
        for more, reason in (({"actions": "push"}, 'actions = .push.: must be "drive" or "gait"'), ({"frames": 0}, "frames"),
                             ({"target": (1, 2)}, "target"), ({"flow": [(99, "left")]}, "flow.0..slice = 99"),
                             ({"frames": None}, "frames = None"), ({"starts": 2.5}, "starts = 2.5"), ({"duration": 0}, "duration = 0"),
                             ({"reached": -1}, "reached = -1: must be at least 0"), ({"work_cost": np.nan}, "work_cost = nan"),
                             ({"work_cost": "a"}, "work_cost = 'a'"), ({"work_cost": 5}, "work_cost = 5: must be 0 in scheme flex"), ({"flow": -1}, "flow = -1"), ({"flow": True}, "flow = True"),
                             ({"flow": 2.5}, "flow = 2.5"), ({"flow": [1, 2]}, "flow = .1, 2.: must be pairs"),
                             ({"target": ((1, 1, 1), (0, 2, 2))}, "the first corner must be the lower one"),
                             ({"target": (9, 0.4, 0.6)},
                              r"target = \[9.0, 0.4, 0.6\]: must be in the tank, x from 0 to 1.54, y from 0, z from 0 to 0.82$"),
                             ({"target": ((1, 0.3, -0.5), (1.4, 0.6, 0.5))}, r"target = \[1.0, 0.3, -0.5\]: must be in the tank"),
                             ({"target": "here"}, "target = 'here': must be numbers"),
                             ({"target": ((1, 1), (1, 1, 1))}, "target: must be numbers, in rows of the same length"),
                             ({"frames": 1001}, "frames = 1001: must be at most 1000"),
                             ({"starts": 2**31 + 1}, "starts = 2147483649: must be at most 2147483648"),
                             ({"flow": 50}, "flow = 50: must be at most the body's \\d+ slices"),
                             ({"gait": natator.Gait(1, [0.5, 0.5], [0, 0.5])}, "gait: must be left out where actions are .drive."),
                             ({"render_mode": "human"}, "render_mode = 'human': must be None or"),
                             ({"scene": "thesis/tank"}, "must have a creature with actuators")):
            with self.assertRaisesRegex(natator.InputError, reason):
                natator.gym.SwimmerEnv(**{**TANK, **more})
        env = natator.gym.SwimmerEnv(**TANK)
        with self.assertRaises(gymnasium.error.ResetNeeded):
            env.step(np.zeros(2))
        env.reset(seed=1)
        for action, reason in (([0, np.nan], r"action\[1\] = nan: must be a finite number"), (["a", "b"], "must be numbers"),
                               ([0], r"must be 2 numbers in \[-1, 1\]"), (None, "action")):
            with self.assertRaisesRegex(natator.InputError, reason):
                env.step(np.array(action))
        with self.assertRaisesRegex(natator.InputError, "options: 'strt' is unknown; must be 'start'"):
            env.reset(options={"strt": 1})
        env.close()
        natator.gym.SwimmerEnv(**TANK, flow=np.int64(2)).close()


    def test_each_action_can_be_taken_with_each_gait_that_is(self):
        widest = natator.Gait(1, [1.5, 1.2], [0, 0.5], offset=[0, -0.3])
        with_room = natator.gym.SwimmerEnv(**TANK, actions="gait", gait=widest)
        with_room.reset(seed=1)
        for action in ([1, 1, 1, 1], [1, 1, -1, -1]):
            with_room.step(np.array(action))
        with_room.close()
        for gait, reason in ((natator.Gait(1, [1.5, 1.6], [0, 0.5]), r"gait: amplitude\[1\] .* are 1.6 together: must be at most 1.5"),
                             ({"frequency": 1, "amplitude": [1, 1], "phase": [0, 0.5], "offset": [-0.6, 0]},
                              r"gait: amplitude\[0\] .* are 1.6 together")):
            with self.assertRaisesRegex(natator.InputError, reason):
                natator.gym.SwimmerEnv(**TANK, actions="gait", gait=gait)


    def test_actions_beyond_the_limits_are_clipped_with_one_warning(self):
        env, limited = (natator.gym.SwimmerEnv(**TANK) for _ in range(2))
        for one in (env, limited):
            one.reset(seed=1)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            for action in ([1.0000001, -3], [7, 0]):
                observation = env.step(np.array(action))[0]
                np.testing.assert_array_equal(observation, limited.step(np.clip(action, -1, 1))[0])
        self.assertEqual(len(told), 1)
        self.assertRegex(str(told[0].message), r"\[1.0000001, -3.0\] is clipped to \[-1, 1\]")
        for one in (env, limited):
            one.close()

    def test_a_video_is_recorded(self):
        with tempfile.TemporaryDirectory() as folder:
            env = gymnasium.make("natator/Swimmer-v0", **TANK, render_mode="rgb_array")
            env = gymnasium.wrappers.RecordVideo(env, f"{folder}/film", episode_trigger=lambda episode: True)
            env.reset(seed=1)
            while not env.step(np.ones(2))[3]:
                pass
            env.close()
            pictures, seconds = imageio_ffmpeg.count_frames_and_secs(f"{folder}/film/rl-video-episode-0.mp4")
        self.assertEqual(pictures, 5)  # one before the four steps
        self.assertAlmostEqual(seconds, 0.25)

    def test_it_is_drawn(self):
        with self.assertRaisesRegex(natator.InputError, 'render_mode = \'ansi\': must be None or "rgb_array"'):
            natator.gym.SwimmerEnv(**TANK, render_mode="ansi")
        env = gymnasium.make("natator/Swimmer-v0", **TANK, render_mode="rgb_array", target=(1.4, 0.4, 0.6))
        self.assertEqual(env.unwrapped.metadata["render_fps"], 20)
        env.reset(seed=1)
        seen = [env.render()]
        env.step(np.ones(2))
        seen.append(env.render())
        blind = natator.gym.SwimmerEnv(**TANK, target=(1.4, 0.4, 0.6))
        blind.reset(seed=1)
        np.testing.assert_array_equal(blind.step(np.ones(2))[0], env.unwrapped._observation())
        self.assertIsNone(blind.render())
        for pixels in seen:
            self.assertEqual((pixels.shape, pixels.dtype), ((400, 640, 3), np.uint8))
            for half in (pixels[:200], pixels[200:]):  # the body, from above and from the side, and the target
                for colour in ((31, 111, 139), (224, 74, 43)):
                    self.assertTrue(np.any(np.all(half == colour, axis=2)), colour)
        self.assertFalse(np.array_equal(*seen))
        env.close()
        blind.close()


class VectorTest(unittest.TestCase):
    def test_where_one_action_is_refused_no_swimmer_begins(self):
        vector = natator.gym.SwimmerVectorEnv(2, **TANK)
        vector.reset(seed=1)
        with self.assertRaisesRegex(natator.InputError, r"environment 1: action\[0\] = nan"):
            vector.step(np.array([[0, 0], [np.nan, 0]]))
        with self.assertRaisesRegex(natator.InputError, "1 actions: must be 2"):
            vector.step(np.zeros((1, 2)))
        with self.assertRaisesRegex(natator.InputError, "actions = 0.5: must be 2, one for each"):
            vector.step(0.5)
        with self.assertRaisesRegex(natator.InputError, r"environment 1: action \[0.0\]: must be 2 numbers"):
            vector.step([[0, 0], [0]])
        observations = vector.step(np.full((2, 2), 0.5))[0]
        vector.close()
        other = natator.gym.SwimmerVectorEnv(2, **TANK)
        other.reset(seed=1)
        np.testing.assert_array_equal(other.step(np.full((2, 2), 0.5))[0], observations)
        other.close()
        with self.assertRaisesRegex(natator.InputError, "num_envs = 0"):
            natator.gym.SwimmerVectorEnv(0, **TANK)

    def test_it_gives_what_single_ones_give(self):
        for more in ({}, {"actions": "gait"}):
            vector = gymnasium.make_vec("natator/Swimmer-v0", num_envs=3, **TANK, **more)
            self.assertIsInstance(vector.unwrapped, natator.gym.SwimmerVectorEnv)
            singles = gymnasium.vector.SyncVectorEnv(
                [lambda: natator.gym.SwimmerEnv(**TANK, **more) for _ in range(3)])
            seen = [[env.reset(seed=11)[0]] for env in (vector, singles)]
            vector.action_space.seed(1)
            for _ in range(7):  # beyond the end of an episode
                actions = vector.action_space.sample()
                for env, observed in zip((vector, singles), seen):
                    observed.extend(env.step(actions)[:4])
            for one, other in zip(*seen):
                np.testing.assert_array_equal(one, other)
            self.assertTrue(np.all(seen[0][1 + 4 * 3 + 3]))  # the fourth step's truncations
            vector.close()
            singles.close()

    def test_an_episode_can_begin_anew_within_the_step_that_ends_it(self):
        vector = natator.gym.SwimmerVectorEnv(2, "SameStep", **TANK)
        singles = gymnasium.vector.SyncVectorEnv([lambda: natator.gym.SwimmerEnv(**TANK) for _ in range(2)],
                                                 autoreset_mode=gymnasium.vector.AutoresetMode.SAME_STEP)
        seen = [[env.reset(seed=5)[0]] for env in (vector, singles)]
        for _ in range(5):
            for env, observed in zip((vector, singles), seen):
                *results, infos = env.step(np.full((2, 2), 0.5))
                observed.extend([*results, np.stack(infos["final_obs"])] if "final_obs" in infos else results)
        self.assertEqual(len(seen[0]), 1 + 5 * 4 + 1)
        for one, other in zip(*seen, strict=True):
            np.testing.assert_array_equal(one, other)
        vector.close()
        singles.close()

    def test_or_by_a_reset_of_those_that_are_named(self):
        vector = natator.gym.SwimmerVectorEnv(2, gymnasium.vector.AutoresetMode.DISABLED, **TANK, render_mode="rgb_array")
        with self.assertRaisesRegex(natator.InputError, "reset_mask = .*: must be 2 booleans, all true the first time"):
            vector.reset(options={"reset_mask": np.array([True, False])})
        first = vector.reset(seed=5)[0]
        self.assertEqual([pixels.shape for pixels in vector.render()], [(400, 640, 3)] * 2)
        for _ in range(4):
            last, *_, truncated, _ = vector.step(np.zeros((2, 2)))
        self.assertTrue(np.all(truncated))
        with self.assertRaisesRegex(gymnasium.error.ResetNeeded, "environment 0 has ended"):
            vector.step(np.zeros((2, 2)))
        again = vector.reset(seed=[5, None], options={"reset_mask": np.array([True, False])})[0]
        np.testing.assert_array_equal(again, [first[0], last[1]])
        with self.assertRaisesRegex(gymnasium.error.ResetNeeded, "environment 1 has ended"):
            vector.step(np.zeros((2, 2)))
        vector.close()
        with self.assertRaisesRegex(natator.InputError, "autoreset_mode = 'later': must be one of NextStep, SameStep, Disabled"):
            natator.gym.SwimmerVectorEnv(2, "later", **TANK)

    def test_seeds(self):
        vector = natator.gym.SwimmerVectorEnv(2, **TANK)
        with self.assertRaisesRegex(natator.InputError, "3 seeds: must be 2"):
            vector.reset(seed=[1, 2, 3])
        vector.action_space.seed(1)
        action = vector.action_space.sample()
        vector.reset(seed=[4, 4])
        action[1] = action[0]
        same = vector.step(action)[0]
        np.testing.assert_array_equal(same[0], same[1])
        for seed in ("a", -1, [1, -1]):
            with self.assertRaisesRegex(natator.InputError, "seed = .*must be a whole number from 0 on"):
                vector.reset(seed=seed)
        vector.close()

    def test_bad_arguments_are_refused(self):
        with self.assertRaisesRegex(natator.InputError, "durration: is no argument"):
            gymnasium.make_vec("natator/Swimmer-v0", num_envs=2, **TANK, durration=0.1)
        with self.assertRaisesRegex(natator.InputError, "durration: is no argument"):
            natator.gym.SwimmerEnv(**TANK, durration=0.1)
        with self.assertRaisesRegex(natator.InputError, "num_envs = 5000: must be at most 4096"):
            natator.gym.SwimmerVectorEnv(5000, **TANK)

    def test_another_body_is_drawn(self):
        vector = natator.gym.SwimmerVectorEnv(2, **TANK, render_mode="rgb_array")
        vector.reset(seed=1)
        vector.reset(options={"overrides": [None, {"fluid": {"count": [12, 7, 9]}}]})
        first, second = vector.render()
        self.assertEqual(first.shape, second.shape)
        vector.close()


if __name__ == "__main__":
    unittest.main()
