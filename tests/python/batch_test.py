"""Many swims in one program, saved moments, and environments over both."""

import os
import unittest
import unittest.mock
import warnings

import gymnasium
import natator
import natator.gym
import numpy as np
from natator.batch import Batch

TANK = "bench/small-tank"
QUICK = {"settling": {"updates": 2}}
ENV = {"scene": TANK, "duration": 0.2, "overrides": QUICK}


def assert_same(one, other):
    for name in one.__dataclass_fields__:
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), err_msg=name)


class StateTest(unittest.TestCase):
    def test_another_process_goes_on_with_the_same_bits(self):
        for scheme in ("flex", "conserving"):
            with natator.Stream(TANK, overrides=QUICK, scheme=scheme, fields=("position", "density")) as first, \
                    natator.Stream(TANK, overrides=QUICK, scheme=scheme, fields=("position", "density")) as second:
                first.step(3, drive=[0.5, -0.5])
                state = first.save()
                ahead = first.step(4, drive=[0.1, 0.2])
                self.assertEqual(second.restore(state).frame, 3)
                self.assertEqual(second.frame.number, 3)
                assert_same(second.step(4, drive=[0.1, 0.2]), ahead)
                np.testing.assert_array_equal(first.frame.density, second.frame.density)
                self.assertEqual(first.restore(state).frame, 3)  # which it has already
                assert_same(first.step(4, drive=[0.1, 0.2]), ahead)

    def test_what_is_no_state_is_refused_in_one_line(self):
        with natator.Stream(TANK, overrides=QUICK) as stream:
            stream.step(2)
            state = stream.save()
            for wrong, reason in ((b"", "there is no state"), (b"natator", "is no saved state"), (state[:-8], "is cut off"),
                                  (state[:100] + b"?" + state[101:], "is damaged"), ("text", "must be bytes")):
                with self.assertRaisesRegex(natator.InputError, reason):
                    stream.restore(wrong)
            self.assertEqual(stream.restore(bytearray(state)).frame, 2)

    def test_an_unstable_swim_goes_back(self):
        with natator.Stream(TANK, overrides=QUICK) as stream:
            stream.step(2)
            state = stream.save()
            stream.ask({"do": "overrides", "overrides": {"solver": {"relaxationMode": "global"}}})
            with self.assertRaises(natator.Unstable):
                stream.step(200)
            with self.assertRaisesRegex(natator.InputError, "unstable"):
                stream.save()
            stream.restore(state)
            self.assertEqual(stream.step(1).frame, 3)


class BatchTest(unittest.TestCase):
    def test_each_has_the_bits_of_one_alone(self):
        actions = np.random.default_rng(1).uniform(-1, 1, (3, 3, 2, 2))
        with Batch(TANK, 3, threads=2, overrides=QUICK, fields="position") as batch:
            alone = [natator.Stream(TANK, overrides=QUICK, fields="position") for _ in range(3)]
            for i, pair in enumerate(zip(batch.swims, alone)):
                for swim in pair:
                    swim.reset(i)
                    swim.sense(flow=[(2, "left")], target=(1.4, 0.4, 0.6))
            for turn in actions:
                for swim, drive in zip(batch.swims, turn):
                    swim.begin_step(drive=drive)
                for swim, one, drive in zip(batch.swims, alone, turn):
                    assert_same(swim.end_step(), one.step(drive=drive))
                    np.testing.assert_array_equal(swim.frame.position, one.frame.position)
            scale, offset = [[1, 0.5], [0.5, 1]], [0.1, -0.1]
            assert_same(batch.swims[1].step(scale=scale, offset=offset), alone[1].step(scale=scale, offset=[offset] * 2))
            self.assertEqual(batch.swims[1].save(), alone[1].save())
            self.assertEqual(batch.swims[2].restore(alone[0].save()).frame, alone[0].sense().frame)
            self.assertEqual(batch.swims[2].save(), alone[0].save())
            for stream in alone:
                stream.close()

    def test_refusals_are_of_one_swim(self):
        with Batch(TANK, 2, overrides=QUICK) as batch:
            first, second = batch.swims
            first.begin_step(drive=[0.5, 0])
            second.begin_step(drive=[5, 0])
            with self.assertRaisesRegex(natator.InputError, r"drive\[0\] = 5: must be a number in \[-2, 2\]"):
                second.end_step()
            self.assertEqual(first.end_step().frame, 1)
            self.assertEqual(second.step().frame, 1)
            with self.assertRaisesRegex(natator.InputError, "scale has 2 rows, offset 3"):
                first.step(scale=np.ones((2, 2)), offset=np.zeros((3, 2)))
            with self.assertRaisesRegex(natator.InputError, "longer than 1 MiB"):
                first.ask({"do": "scene", "scene": "x" * 2**20})
            first.begin_step()
            with self.assertRaisesRegex(natator.ProgramError, "a step was begun"):
                first.sense()
            self.assertEqual(first.end_step().frame, 2)
        for count, reason in ((0, "count = 0"), (4097, "at most 4096"), (1.5, "count")):
            with self.assertRaisesRegex(natator.InputError, reason):
                Batch(TANK, count)


class ResetTest(unittest.TestCase):
    def test_an_episode_begins_in_a_developed_wake(self):
        env = natator.gym.SwimmerEnv(**ENV)
        env.reset(seed=1)
        env.step(np.array([0.5, -0.5]))
        state = env.save()
        ahead = env.step(np.array([0.2, 0.1]))
        observation, info = env.reset(options={"state": state})
        self.assertAlmostEqual(info["time"], 0.05)
        self.assertEqual(len(ahead), 5)
        ends = [env.step(np.zeros(2))[3] for _ in range(4)]
        self.assertEqual(ends, [False, False, False, True])  # by its own duration, not the swim's
        vector = natator.gym.SwimmerVectorEnv(2, **ENV)
        observations = vector.reset(seed=1, options={"state": [state, None]})[0]
        np.testing.assert_array_equal(observations[0], observation)
        self.assertFalse(np.array_equal(*observations))
        for one in (env, vector):
            one.close()

    def test_settings_of_its_own(self):
        vector, alone = natator.gym.SwimmerVectorEnv(2, **ENV), natator.gym.SwimmerEnv(**ENV)
        thick = {"solver": {"viscosity": 2.5}}
        vector.reset(seed=[5, 5], options={"overrides": [None, thick]})
        alone.reset(seed=5, options={"overrides": thick})
        seen = vector.step(np.full((2, 2), 0.5))[0]
        np.testing.assert_array_equal(seen[1], alone.step(np.full(2, 0.5))[0])
        self.assertFalse(np.array_equal(*seen))
        for options, reason in (({"overrides": [thick]}, "overrides has 1 values: must be 2"),
                                ({"overrides": [None, {"solver": {"viscosity": -1}}]}, "environment 1: .*viscosity"),
                                ({"start": [1, -2]}, "environment 1: start"), ({"state": [b"?", None]}, "environment 0: state"),
                                ({"strt": 1}, "environment 0: options: 'strt' is unknown")):
            with self.assertRaisesRegex(natator.InputError, reason):
                vector.reset(seed=1, options=options)
        vector.reset(seed=[5, 5], options={"overrides": {"solver": {"viscosity": None}}})
        same = vector.step(np.full((2, 2), 0.5))[0]
        np.testing.assert_array_equal(same[0], same[1])
        for one in (vector, alone):
            one.close()

    def test_an_unstable_one_ends_alone(self):
        vector = natator.gym.SwimmerVectorEnv(3, **ENV | {"frames": 60, "duration": 9.0})
        vector.reset(seed=1)
        vector.envs[1]._stream.ask({"do": "overrides", "overrides": {"solver": {"relaxationMode": "global"}}})
        *_, terminated, truncated, infos = vector.step(np.full((3, 2), 0.3))
        self.assertEqual(infos["unstable"].tolist(), [False, True, False])
        self.assertTrue(terminated[1])
        for _ in range(3):  # so are its starts, each of which ends at once; the others go on
            *_, terminated, truncated, infos = vector.step(np.full((3, 2), 0.3))
            self.assertEqual((infos["unstable"].tolist(), terminated.tolist()), ([False, True, False],) * 2)
            self.assertEqual(infos["unstable"].dtype, bool)
            self.assertTrue(np.all(infos["time"][[0, 2]] > 0))
        with self.assertRaisesRegex(natator.InputError, "environment 1: unstable at 0 s"):
            vector.reset(seed=1)
        vector.reset(seed=1, options={"overrides": {"solver": {"relaxationMode": "local"}}})
        self.assertFalse(np.any(vector.step(np.full((3, 2), 0.3))[4]["unstable"]))
        vector.close()

    def test_what_is_refused_changes_nothing_and_the_others_begin(self):
        fewer = {"creature": {"joints": [1, 3, 5, 7]}}
        with natator.Stream(TANK, overrides=fewer) as stream:
            of_another = stream.save()
        vector, other = (natator.gym.SwimmerVectorEnv(2, **ENV) for _ in range(2))
        for options, reason in (({"overrides": [None, fewer]}, "swimmer 0 would have 3 actuators: must have 2"), ({"state": [None, of_another]}, "swimmer 0 would have 3 actuators"),
                                ({"start": [1, 2**31]}, "start = 2147483648")):
            vector.reset(seed=1)
            vector.step(np.full((2, 2), 0.5))
            with self.assertRaisesRegex(natator.InputError, f"environment 1: .*{reason}"):
                vector.reset(seed=7, options=options)
            observations = vector.step(np.full((2, 2), 0.5))[0]
            other.reset(seed=7, options={"start": 1} if "start" in options else None)
            np.testing.assert_array_equal(observations[0], other.step(np.full((2, 2), 0.5))[0][0])
            self.assertTrue(np.all(np.isfinite(vector.reset(seed=1)[0])))
        single = natator.gym.SwimmerEnv(**ENV)
        first = single.reset(seed=1)[0]
        with self.assertRaisesRegex(natator.InputError, "start = 2147483648"):
            single.reset(options={"start": 2**31})
        np.testing.assert_array_equal(single.reset(seed=1)[0], first)
        for one in (vector, other, single):
            one.close()

    def test_bodies_of_other_lengths_swim_side_by_side(self):
        longer = {"creature": {"slices": [{"height": 3, "width": 3, "count": 11}]}}
        vector, alone = natator.gym.SwimmerVectorEnv(2, **ENV), natator.gym.SwimmerEnv(**ENV)
        vector.reset(seed=[5, 5], options={"overrides": [None, longer]})
        alone.reset(seed=5, options={"overrides": longer})
        np.testing.assert_array_equal(vector.step(np.full((2, 2), 0.5))[0][1], alone.step(np.full(2, 0.5))[0])
        self.assertEqual([env.length for env in vector.envs], [0.6, 0.75])
        vector.reset(options={"overrides": [{"creature": {"slices": [{"height": 3, "width": 3, "count": 8}]}}, None]})  # places go along
        self.assertTrue(np.all(np.isfinite(vector.step(np.full((2, 2), 0.5))[0])))
        state = alone.save()  # which brings its body
        fresh = natator.gym.SwimmerEnv(**ENV)
        fresh.reset(seed=1)
        np.testing.assert_array_equal(fresh.reset(options={"state": state})[0], alone.reset(options={"state": state})[0])
        self.assertEqual(fresh.length, 0.75)
        pinned = natator.gym.SwimmerEnv(**ENV, flow=[(8, "left")])
        with self.assertRaisesRegex(natator.InputError, "swimmer 0 would have 8 slices: must have at least 9"):
            pinned.reset(options={"overrides": {"creature": {"slices": [{"height": 3, "width": 3, "count": 8}]}}})
        pinned.reset(seed=1)
        for one in (vector, alone, fresh, pinned):
            one.close()

    def test_an_ended_program_says_whose_it_was_until_a_reset_starts_another(self):
        vector, other = (natator.gym.SwimmerVectorEnv(2, **ENV) for _ in range(2))
        began, _ = vector.reset(seed=1)
        other.reset(seed=1)
        vector._batch._program._process.kill()
        for _ in range(2):
            with self.assertRaisesRegex(natator.ProgramError, "^environments 0 to 1: natator-sim has ended, exit code -9"):
                vector.step(np.zeros((2, 2)))
        with self.assertRaisesRegex(natator.InputError, "reset_mask"):
            vector.reset(options={"reset_mask": np.array([True, False])})  # nothing is left of the other
        np.testing.assert_array_equal(vector.reset(seed=1)[0], began)
        for env in (vector, other):
            env.step(np.zeros((2, 2)))
        vector._batch._program._process.kill()
        vector._batch._program._process.wait()
        np.testing.assert_array_equal(vector.reset()[0], other.reset()[0], "the starts that it draws are those of one whose program lived")
        for env in (vector, other):
            env.close()
        with self.assertRaisesRegex(natator.ProgramError, "natator-sim is closed"):
            vector.reset()

    def test_an_interrupted_call_or_a_failed_start_is_begun_again(self):
        vector = natator.gym.SwimmerVectorEnv(2, **ENV)
        began, _ = vector.reset(seed=1)
        with unittest.mock.patch.object(Batch, "hear", side_effect=KeyboardInterrupt), self.assertRaises(KeyboardInterrupt):
            vector.step(np.zeros((2, 2)))
        with self.assertRaisesRegex(natator.ProgramError, "interrupted"):
            vector.step(np.zeros((2, 2)))
        with unittest.mock.patch.object(Batch, "hear", side_effect=KeyboardInterrupt), self.assertRaises(KeyboardInterrupt):
            vector.reset(seed=1)
        with unittest.mock.patch.dict(os.environ, NATATOR_SIM="/no/natator-sim"), self.assertRaisesRegex(natator.ProgramError, "/no/natator-sim"):
            vector.reset(seed=1)
        np.testing.assert_array_equal(vector.reset(seed=1)[0], began)
        vector.close()

    def test_swims_of_unlike_bodies_go_on_by_themselves(self):
        with Batch(TANK, 2, overrides=QUICK) as batch:
            batch.swims[1].ask({"do": "scene", "scene": TANK, "overrides": {**QUICK, "creature": {"joints": [1, 3, 5, 7]}}})
            with self.assertRaisesRegex(natator.InputError, "swim 1: senses are .* numbers: must be"):
                batch.step(np.zeros((2, 1, 2)), np.array([True, False]))
            self.assertEqual([swim.step().frame for swim in batch.swims], [2, 1])

    def test_threads_and_place_change_no_bit(self):
        seen = []
        for threads in (1, 2):
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                vector = gymnasium.make_vec("natator/Swimmer-v0", num_envs=3, vectorization_mode="vector_entry_point",
                                            threads=threads, **ENV)
            vector.reset(seed=3)
            vector.action_space.seed(1)
            seen.append([vector.step(vector.action_space.sample())[0] for _ in range(6)])
            vector.close()
        np.testing.assert_array_equal(*seen)


if __name__ == "__main__":
    unittest.main()
