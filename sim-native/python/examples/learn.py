#!/usr/bin/env python3
"""Learns to swim by PPO (Schulman et al. 2017) in many environments at a time, then swims from starts that learning never drew."""

import argparse
import contextlib
import json
import os
import time

import numpy as np
from skrl.agents.jax.ppo import PPO
from skrl.envs.wrappers.jax import wrap_env
from skrl.memories.jax import RandomMemory
from skrl.trainers.jax import SequentialTrainer
from skrl.utils import set_seed
from skrl.utils.model_instantiators.jax import deterministic_model, gaussian_model

from natator import InputError, gym, policy, script

GAIT = {"frequency": 2, "amplitude": [0.4, 0.35, 0.3, 0.25, 0.2], "phase": [0, 0.902, 0.804, 0.706, 0.608]}  # sim-native/examples/gaits/loach.json
TASKS = {"ahead": {}, "turn": {"target": [[2.4, 0.01, -1.2], [3.9, 0.01, 2.8]], "reached": 0.25},
         "station": {"target": [[2.2, 0.01, 0.6], [2.6, 0.01, 1]], "reached": 0, "overrides": {"movingTank": {"current": [-0.4, 0, 0]}}}}
parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
parser.add_argument("folder", help="gets policy.json and curve.csv; a policy that is there is swum, not learned again")
parser.add_argument("task", nargs="?", choices=TASKS, default="ahead", help="ahead along x; to targets in a box; or to stay at one in a current")
for name, kind, default, text in (
        ("env", json.loads, {}, "arguments of SwimmerVectorEnv, over those of the task"), ("check", json.loads, {}, "overrides to swim with at last, too"),
        ("num-envs", int, 64, "at a time"), ("steps", int, 1500, "of each; Ctrl-C ends it before"), ("rollouts", int, 8, "steps between updates"),
        ("seed", int, 1, "of all"), ("log-std", float, -0.5, "logarithm of the actions' standard deviation at first"),
        ("fall", float, 0, "taken off the reward where a swim becomes unstable, body lengths"), ("backend", str, "auto", "cpu, cuda or auto")):
    parser.add_argument(f"--{name}", type=kind, default=default, help=text)
options = parser.parse_args()
environment = {"scene": "plane/loach", "actions": "gait", "gait": GAIT, "frames": 6, "flow": [], "target": None, **TASKS[options.task], **options.env}


class Episodes(gym.SwimmerVectorEnv):
    """Keeps the mean return of episodes that end together, body lengths."""
    rows, sums, taken, begin = [], 0, 0, time.time()

    def step(self, actions):
        observations, rewards, terminated, truncated, infos = super().step(actions)
        self.sums, self.taken, ended = self.sums + rewards, self.taken + 1, terminated | truncated
        if np.any(ended):
            self.rows.append([round(time.time() - self.begin, 1), np.sum(ended), round(self.sums[ended].mean(), 4)])
            self.sums = np.where(ended, 0, self.sums)
        return observations, rewards - options.fall * np.array(infos.get("final_info", {}).get("unstable") == 1), terminated, truncated, infos


def learn_and_swim(_):
    if min(options.steps, options.rollouts) < 1:
        raise InputError("--steps, --rollouts: must be at least 1")
    if not os.path.exists(f"{options.folder}/policy.json"):
        env = Episodes(options.num_envs, "SameStep", backend=options.backend, **environment)
        env.reset(seed=1000 * options.seed)
        set_seed(options.seed)
        wrapped = wrap_env(env, wrapper="gymnasium")
        spaces = {"observation_space": wrapped.observation_space, "action_space": wrapped.action_space, "device": wrapped.device}
        network = [{"name": "net", "input": "OBSERVATIONS", "layers": [64, 64], "activations": "tanh"}]
        models = {"policy": gaussian_model(**spaces, initial_log_std=options.log_std, network=network, output="ACTIONS"),
                  "value": deterministic_model(**spaces, network=network, output="ONE")}
        for role, model in models.items():
            model.init_state_dict(role=role)
        agent = PPO(models=models, memory=RandomMemory(memory_size=options.rollouts, num_envs=env.num_envs, device=wrapped.device), **spaces,
                    cfg={"rollouts": options.rollouts, "mini_batches": 4, "discount_factor": 0.98, "grad_norm_clip": 0.5,
                         "rewards_shaper": lambda rewards, *_: 10 * rewards, "experiment": {"write_interval": 0, "checkpoint_interval": 0}})
        with contextlib.suppress(KeyboardInterrupt):  # what is learned is kept
            SequentialTrainer(env=wrapped, agents=agent, cfg={"timesteps": options.steps, "headless": True, "close_environment_at_exit": False}).train()
        env.close()
        os.makedirs(options.folder, exist_ok=True)
        np.savetxt(f"{options.folder}/curve.csv", env.rows, "%.6g", ",", header="seconds,episodes,mean_return", comments="")
        print(f"{env.taken * env.num_envs} steps in {time.time() - env.begin:.0f} s")
        layers = [models["policy"].state_dict.params["params"]["net_container"][f"layers_{k}"] for k in (0, 2, 4)]  # tanh is between
        policy.save(f"{options.folder}/policy.json", environment, [(layer["kernel"], layer["bias"]) for layer in layers])
    for overrides in [{}, options.check][:1 + bool(options.check)]:
        returns = policy.Policy(f"{options.folder}/policy.json").swims(range(1000, 1016), range(500, 516), overrides, options.backend)["return"]
        print(f"{options.task}, overrides {overrides}: {returns.mean():.4g} body lengths, standard deviation {returns.std(ddof=1):.2g}, {len(returns)} new starts")


script.run(parser, learn_and_swim)
