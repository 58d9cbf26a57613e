"""Policies that were learned: networks from what a swimmer senses to its next action, in JSON."""

import json
import os

import numpy as np

from natator.errors import InputError


class Policy:
    """A network of dense layers, with tanh after each but the last, as examples/learn.py saves it; `natator view --policy` shows it.

    path: of its JSON. Called with observations of a SwimmerEnv (… × inputs) it returns actions (… × outputs). Attribute
    `environment`: arguments of the SwimmerEnv that it was learned in. Raises InputError.
    """

    def __init__(self, path):
        try:
            with open(path, encoding="utf-8") as file:
                told = json.load(file)
            self.environment = dict(told["environment"])
            self.layers = [(np.array(layer["weights"], float), np.array(layer["bias"], float)) for layer in told["layers"]]
            sizes = [len(self.layers[0][0]), *(len(bias) for _, bias in self.layers)]
            if not all(weights.shape == size and np.all(np.isfinite(weights)) and np.all(np.isfinite(bias))
                       for (weights, bias), size in zip(self.layers, zip(sizes, sizes[1:]))):
                raise ValueError
        except OSError as error:
            raise InputError(f"{os.fspath(path)}: {error.strerror}") from None
        except (IndexError, KeyError, TypeError, ValueError):
            raise InputError(f'{os.fspath(path)}: must be a policy, {{"environment": …, "layers": [{{"weights": …, "bias": …}}]}}, with layers of finite numbers '
                             "that fit together") from None

    def __call__(self, observations):
        for weights, bias in self.layers[:-1]:
            observations = np.tanh(observations @ weights + bias)
        weights, bias = self.layers[-1]
        return np.clip(observations @ weights + bias, -1, 1)

    def swims(self, starts, seeds, overrides=None, backend="auto", act=None):
        """Episodes from these starts, to targets drawn by these seeds, without noise. overrides: more of them, on the scene's. act:
        called in place of the policy. Returns a dict of arrays, an item for each: "return"; "time", s; "reached" and "unstable", booleans;
        with targets "away", the mean distance from it over the episode, body lengths; and "centre", steps × 3, NaN after the end."""
        from natator.gym import SwimmerVectorEnv
        with_target, count = self.environment.get("target") is not None, len(starts)
        env = SwimmerVectorEnv(count, "SameStep", backend=backend, **self.environment)
        try:
            observations, infos = env.reset(seed=list(seeds), options={"start": list(starts), "overrides": overrides or {}})
            told = {"return": np.zeros(count), "time": np.zeros(count), "reached": np.zeros(count, bool), "unstable": np.zeros(count, bool)}
            going, centres, away = np.ones(count, bool), [infos["centre"]], []
            while np.any(going):
                observations, rewards, terminated, truncated, infos = env.step((act or self)(observations))
                ended, seen, centre = terminated | truncated, observations.copy(), infos["centre"].copy()
                for i in np.flatnonzero(ended):
                    seen[i], centre[i] = infos["final_obs"][i], infos["final_info"]["centre"][i]
                    if going[i]:
                        told["time"][i] = infos["final_info"]["time"][i]
                        told["reached"][i], told["unstable"][i] = infos["final_info"]["reached"][i], infos["final_info"]["unstable"][i]
                told["return"] += np.where(going, rewards, 0)
                centres.append(np.where(going[:, None], centre, np.nan))
                away.append(np.where(going, seen[:, -1], np.nan))
                going &= ~ended
            return told | {"centre": np.stack(centres, axis=1)} | ({"away": np.nanmean(away, axis=0)} if with_target else {})
        finally:
            env.close()


def save(path, environment, layers):
    """Writes a policy. environment: arguments of SwimmerEnv, among them scene, actions, gait, frames, flow as (slice, side) pairs, target
    and reached; layers: of (weights, inputs × outputs; bias), rounded to 5 decimals."""
    layers = [{"weights": np.round(np.array(weights, float), 5).tolist(), "bias": np.round(np.array(bias, float), 5).tolist()} for weights, bias in layers]
    with open(path, "w", encoding="utf-8") as file:
        json.dump({"environment": environment, "layers": layers}, file)
