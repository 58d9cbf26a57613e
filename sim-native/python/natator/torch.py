"""Swimmers side by side with tensors of PyTorch in place of arrays."""

import gymnasium
import numpy as np
import torch

from natator.errors import InputError


class TensorVectorEnv(gymnasium.vector.VectorWrapper):
    """A vector environment of natator.gym whose actions and observations are tensors.

    env: of gymnasium.make_vec("natator/Swimmer-v0", …), also in wrappers for arrays. device: as of torch.device, where tensors
    are given: observations, num_envs × size, and rewards, num_envs, of 32-bit numbers; terminated and truncated, num_envs booleans;
    and what infos has as arrays, of the same types, "final_obs" as one tensor, with rows of 0 for environments that go on.
    Actions, num_envs × size, and "reset_mask" may lie on any device, actions of any type of numbers. Senses are made and muscles
    driven in the host's memory: tensors are copied from and to it with each step. Raises InputError.
    """

    def __init__(self, env, device="cuda"):
        super().__init__(env)
        try:
            self.device = torch.empty(0, device=device).device
        except (RuntimeError, AssertionError, TypeError) as error:  # AssertionError: torch without CUDA
            raise InputError(f"device = {device!r}: must be one that torch has here: {str(error).splitlines()[0]}") from error

    def reset(self, *, seed=None, options=None):
        """As of the environment."""
        options = {key: _array(value) for key, value in (options or {}).items()}
        observations, infos = self.env.reset(seed=seed, options=options)
        return self._tensor(observations), self._tensors(infos)

    def step(self, actions):
        """As of the environment."""
        observations, rewards, terminated, truncated, infos = self.env.step(_array(actions))
        return (self._tensor(observations), self._tensor(rewards.astype(np.float32)), self._tensor(terminated), self._tensor(truncated),
                self._tensors(infos))

    def _tensor(self, array):
        return torch.from_numpy(array).to(self.device)

    def _tensors(self, infos):
        """Infos, and those within them, with tensors in place of arrays."""
        told = {}
        for key, value in infos.items():
            if key == "final_obs":
                rows = np.zeros(self.observation_space.shape, np.float32)
                for i in np.flatnonzero(infos["_final_obs"]):
                    rows[i] = value[i]
                value = rows
            told[key] = self._tensors(value) if isinstance(value, dict) else self._tensor(value) if isinstance(value, np.ndarray) else value
        return told


def _array(value):
    """A tensor as an array; all else as it is."""
    if not isinstance(value, torch.Tensor):
        return value
    return value.detach().to("cpu", torch.bool if value.dtype == torch.bool else torch.float64).numpy()
