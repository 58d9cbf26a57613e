#!/usr/bin/env python3
"""Learns to swim by PPO (Schulman et al. 2017, of skrl) in many environments at a time, and swims it from starts that learning never drew."""

import argparse
import csv
import os
import time

import flax.linen as nn
import numpy as np
from skrl import config
from skrl.agents.jax.ppo import PPO
from skrl.envs.wrappers.jax import wrap_env
from skrl.memories.jax import RandomMemory
from skrl.models.jax import DeterministicMixin, GaussianMixin, Model
from skrl.trainers.jax import SequentialTrainer

from natator.gym import SwimmerVectorEnv

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter, allow_abbrev=False)
parser.add_argument("folder", help="gets curve.csv, returns.csv of new starts, and agent.pickle")
parser.add_argument("--scene", default="pool/tadpole")
parser.add_argument("--target", type=float, nargs=3, help="where to; without it, ahead")
parser.add_argument("--num-envs", type=int, default=256)
parser.add_argument("--steps", type=int, default=3200, help="of each environment")
parser.add_argument("--rollouts", type=int, default=40, help="steps between updates")
parser.add_argument("--duration", type=float, default=4.0, help="of an episode, s")
parser.add_argument("--backend", default="auto")
parser.add_argument("--seed", type=int, default=1)
options = parser.parse_args()


def network(inputs, outputs):
    return nn.Dense(outputs)(nn.tanh(nn.Dense(64)(nn.tanh(nn.Dense(64)(inputs["observations"])))))


class Policy(GaussianMixin, Model):
    def __init__(self, **spaces):
        Model.__init__(self, **spaces)
        GaussianMixin.__init__(self)

    @nn.compact
    def __call__(self, inputs, role):
        return network(inputs, self.num_actions), {"log_std": self.param("log_std", lambda _: np.full(self.num_actions, -0.5, np.float32))}


class Value(DeterministicMixin, Model):
    def __init__(self, **spaces):
        Model.__init__(self, **spaces)
        DeterministicMixin.__init__(self)

    @nn.compact
    def __call__(self, inputs, role):
        return network(inputs, 1), {}


class Episodes(SwimmerVectorEnv):
    """Keeps the mean return of episodes that end together, body lengths."""
    rows, sums, begin = [["seconds", "episodes", "mean_return"]], 0, time.time()

    def step(self, actions):
        observations, rewards, terminated, truncated, infos = super().step(actions)
        self.sums, ended = self.sums + rewards, terminated | truncated
        if np.any(ended):
            self.rows.append([round(time.time() - self.begin, 1), np.sum(ended), self.sums[ended].mean()])
            self.sums = np.where(ended, 0, self.sums)
        return observations, rewards, terminated, truncated, infos


env = Episodes(options.num_envs, "SameStep", scene=options.scene, target=options.target, duration=options.duration, backend=options.backend)
wrapped = wrap_env(env, wrapper="gymnasium")
config.jax.key = options.seed
spaces = {"observation_space": wrapped.observation_space, "action_space": wrapped.action_space, "device": wrapped.device}
models = {"policy": Policy(**spaces), "value": Value(**spaces)}
for role, model in models.items():
    model.init_state_dict(role=role)
agent = PPO(models=models, memory=RandomMemory(memory_size=options.rollouts, num_envs=env.num_envs, device=wrapped.device), **spaces,
            cfg={"rollouts": options.rollouts, "mini_batches": 4, "discount_factor": 0.98, "grad_norm_clip": 0.5,
                 "rewards_shaper": lambda rewards, *_: 10 * rewards, "experiment": {"write_interval": 0, "checkpoint_interval": 0}})
SequentialTrainer(env=wrapped, agents=agent, cfg={"timesteps": options.steps, "headless": True, "close_environment_at_exit": False}).train()

# Without noise, from starts that learning never drew.
observations, _ = env.reset(options={"start": [1000 + k for k in range(env.num_envs)]})
returns, over = np.zeros((2, env.num_envs))
while not np.all(over):
    observations, rewards, terminated, truncated, _ = env.step(agent.act(observations, None, timestep=0, timesteps=0)[1]["mean_actions"])
    returns, over = returns + np.where(over, 0, rewards), np.maximum(over, terminated | truncated)
env.close()
os.makedirs(options.folder, exist_ok=True)
with open(f"{options.folder}/curve.csv", "w", newline="") as file:
    csv.writer(file).writerows(env.rows)
np.savetxt(f"{options.folder}/returns.csv", returns, "%.4f")
agent.save(f"{options.folder}/agent.pickle")
print(f"{options.scene}: {returns.mean():.3f} body lengths in {options.duration:g} s, standard deviation {returns.std(ddof=1):.3f} "
      f"of {env.num_envs} new starts")
