"""Environments with tensors, by PyTorch and by Stable-Baselines3, whose checker and PPO must take them as they are."""

import unittest
import warnings

import gymnasium
import natator
import numpy as np
import torch
from gymnasium.vector import AutoresetMode
from natator.gym import SwimmerVectorEnv
from natator.torch import TensorVectorEnv
from stable_baselines3 import PPO
from stable_baselines3.common.env_checker import check_env

TANK = {"scene": "bench/small-tank", "duration": 0.2}


class TensorsTest(unittest.TestCase):
    def assert_same(self, tensors, arrays, path=""):
        for key, array in arrays.items():
            with self.subTest(path + key):
                if isinstance(array, dict):
                    self.assert_same(tensors[key], array, f"{path}{key}.")
                elif key == "final_obs":
                    for i, one in enumerate(array):
                        np.testing.assert_array_equal(tensors[key][i].numpy(), 0 if one is None else one)
                else:
                    self.assertEqual(tensors[key].numpy().dtype, array.dtype)
                    np.testing.assert_array_equal(tensors[key].numpy(), array)

    def test_tensors_have_the_numbers_of_arrays(self):
        for mode in AutoresetMode:
            with self.subTest(mode):
                arrays = SwimmerVectorEnv(3, mode, **TANK)
                env = TensorVectorEnv(SwimmerVectorEnv(3, mode, **TANK), "cpu")
                observations, infos = env.reset(seed=4)
                expected, expected_infos = arrays.reset(seed=4)
                np.testing.assert_array_equal(observations.numpy(), expected)
                self.assert_same(infos, expected_infos)
                generator, ends = torch.Generator().manual_seed(2), 0
                for _ in range(6):
                    actions = torch.rand((3, arrays.single_action_space.shape[0]), generator=generator, requires_grad=True) - 0.5
                    told, expected = env.step(actions), arrays.step(actions.detach().numpy())
                    for one, other, kind in zip(told, expected, (torch.float32, torch.float32, torch.bool, torch.bool)):
                        self.assertEqual(one.dtype, kind)
                        np.testing.assert_array_equal(one.numpy(), other.astype(one.numpy().dtype))
                    self.assert_same(told[-1], expected[-1])
                    ended = told[2] | told[3]
                    ends += int(ended.sum())
                    if mode == AutoresetMode.DISABLED and ended.any():
                        again = env.reset(options={"reset_mask": ended})[0]
                        np.testing.assert_array_equal(again.numpy(), arrays.reset(options={"reset_mask": ended.numpy()})[0])
                self.assertGreaterEqual(ends, 3)
                env.close()
                arrays.close()

    def test_make_vec_and_wrong_devices(self):
        env = gymnasium.make_vec("natator/Swimmer-v0", num_envs=2, **TANK)
        for device in ("abacus", "cuda:99", 1.5):
            with self.subTest(device), self.assertRaisesRegex(natator.InputError, "device = .*: must be one that torch has here"):
                TensorVectorEnv(env, device)
        tensors = TensorVectorEnv(env, "cpu")
        tensors.reset(seed=1)
        tensors.step(torch.zeros((2, 2), dtype=torch.bfloat16))
        with self.assertRaisesRegex(natator.InputError, "^actions = 0.0: must be 2"):
            tensors.step(torch.tensor(0.0))
        with self.assertRaisesRegex(natator.InputError, "^environment 0: "):
            tensors.step([["0.5", "1"], ["0.5", "1"]])
        with self.assertRaisesRegex(natator.InputError, r"^environment 1: action\[1\] = nan: must be a finite number"):
            tensors.step(torch.tensor([[0, 0], [0, torch.nan]]))
        tensors.close()


class StableBaselinesTest(unittest.TestCase):
    def test_its_checker(self):
        for more in ({}, {"actions": "gait"}, {"target": ((1, 0.3, 0.3), (1.4, 0.6, 0.5))}, {"overrides": {"scheme": "conserving"}, "work_cost": 1e-6}):
            with self.subTest(more), warnings.catch_warnings():
                warnings.simplefilter("error")
                env = gymnasium.make("natator/Swimmer-v0", **TANK, **more)
                check_env(env)
                env.close()

    def test_its_ppo_learns(self):
        env = gymnasium.make("natator/Swimmer-v0", **TANK)
        model = PPO("MlpPolicy", env, n_steps=8, batch_size=8, n_epochs=1, device="cpu", seed=1)
        before = [weight.clone() for weight in model.policy.parameters()]
        model.learn(16)
        self.assertTrue(any(not torch.equal(one, other) for one, other in zip(before, model.policy.parameters())))
        env.close()


if __name__ == "__main__":
    unittest.main()
