#!/usr/bin/env python3
"""Learns to swim by PPO (Schulman et al. 2017) in many environments at a time, then swims from starts that learning never drew."""

import argparse
import csv
import json
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

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
parser.add_argument("folder", help="gets policy.npz and curve.csv; a policy that is there is swum, not learned again")
parser.add_argument("--scene", default="endless/small")
parser.add_argument("--vary", type=json.loads, nargs="*", default=[{}], help="overrides that environments learn with by turns")
parser.add_argument("--check", type=json.loads, nargs="*", default=[{}], help="overrides to swim with in the end")
parser.add_argument("--target", type=float, nargs="*", default=[], metavar="X", help="where to; without it, ahead")
for name, default, text in (("num-envs", 256, "at a time"), ("steps", 1500, "of each"), ("rollouts", 20, "steps between updates"), ("seed", 1, "of all")):
    parser.add_argument(f"--{name}", type=int, default=default, help=text)
parser.add_argument("--duration", type=float, default=4.0, help="of an episode, s")
parser.add_argument("--backend", default="auto", help="cpu, cuda or auto")
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
            self.rows.append([round(time.time() - self.begin, 1), np.sum(ended), round(self.sums[ended].mean(), 4)])
            self.sums = np.where(ended, 0, self.sums)
        return observations, rewards, terminated, truncated, infos


def environments():
    return Episodes(options.num_envs, "SameStep", backend=options.backend, scene=options.scene, target=options.target or None, duration=options.duration)


def learn():
    env = environments()
    env.reset(options={"overrides": [options.vary[k % len(options.vary)] for k in range(env.num_envs)]})  # from now on
    config.jax.key = options.seed
    wrapped = wrap_env(env, wrapper="gymnasium")
    spaces = {"observation_space": wrapped.observation_space, "action_space": wrapped.action_space, "device": wrapped.device}
    models = {"policy": Policy(**spaces), "value": Value(**spaces)}
    for role, model in models.items():
        model.init_state_dict(role=role)
    agent = PPO(models=models, memory=RandomMemory(memory_size=options.rollouts, num_envs=env.num_envs, device=wrapped.device), **spaces,
                cfg={"rollouts": options.rollouts, "mini_batches": 4, "discount_factor": 0.98, "grad_norm_clip": 0.5,
                     "rewards_shaper": lambda rewards, *_: 10 * rewards, "experiment": {"write_interval": 0, "checkpoint_interval": 0}})
    SequentialTrainer(env=wrapped, agents=agent, cfg={"timesteps": options.steps, "headless": True, "close_environment_at_exit": False}).train()
    env.close()
    os.makedirs(options.folder, exist_ok=True)
    with open(f"{options.folder}/curve.csv", "w", newline="") as file:
        csv.writer(file).writerows(env.rows)
    print(f"{options.steps * env.num_envs} steps in {time.time() - env.begin:.0f} s")
    layers = models["policy"].state_dict.params["params"]
    np.savez(f"{options.folder}/policy.npz", *[layers[f"Dense_{k}"][part] for k in (2, 1, 0) for part in ("kernel", "bias")])  # inmost first


def swim(env, layers, overrides=None):
    """Returns without noise in the actions."""
    observations, _ = env.reset(options={"start": [1000 + k for k in range(env.num_envs)], "overrides": overrides})
    returns, over = np.zeros((2, env.num_envs))
    while not np.all(over):
        hidden = np.tanh(np.tanh(observations @ layers[0] + layers[1]) @ layers[2] + layers[3])
        observations, rewards, terminated, truncated, _ = env.step(hidden @ layers[4] + layers[5])
        returns, over = returns + np.where(over, 0, rewards), np.maximum(over, terminated | truncated)
    print(f"{options.scene}, overrides {overrides}: {returns.mean():.4g} body lengths, standard deviation {returns.std(ddof=1):.2g}, "
          f"{env.num_envs} new starts of {options.duration:g} s")
    return returns


if not os.path.exists(f"{options.folder}/policy.npz"):
    learn()
env = environments()
layers = list(np.load(f"{options.folder}/policy.npz").values())
for overrides in options.check:
    swim(env, layers, overrides)
env.close()
